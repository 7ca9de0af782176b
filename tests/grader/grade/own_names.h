#pragma once

#include "grader/grade/foreign_symbols.h"

#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// Which names of a lab's objects get a new one before they are linked, by file.
using NewNames = std::map<std::string, std::vector<std::string>>;

/// Steps of a lab are files that know nothing of each other: where several define a function or
/// variable of the same name, each shall use its own. The name stays with the file whose stub
/// defines it, else with the first; in the others it is changed. What headers make several files
/// define is left to the linker, as are names of odd characters. `objects` and `stubs`: the symbols
/// of each file's object.
NewNames own_names(const std::map<std::string, Symbols>& objects,
                   const std::map<std::string, Symbols>& stubs);

/// The lines that objcopy's --redefine-syms takes for one file's names.
std::string redefinitions(const std::vector<std::string>& names, const std::string& file);

/// For the student: which names were made each file's own.
std::string own_names_text(const NewNames& names);

}  // namespace carlo::grader
