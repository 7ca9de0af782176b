#pragma once

#include "grader/grade/foreign_symbols.h"

#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// The names in a lab's objects that get a new name before linking, by file.
using NewNames = std::map<std::string, std::vector<std::string>>;

/// Returns new names. The steps of a lab are files that know nothing of each other: if several
/// define a function or variable of the same name, each must use its own. The file whose stub
/// defines the name keeps it, else the first; in the others it changes. Definitions from headers
/// are left to the linker, as are unusual names. `objects` and `stubs`: the symbols of each file's
/// object.
NewNames own_names(const std::map<std::string, Symbols>& objects,
                   const std::map<std::string, Symbols>& stubs);

/// Returns the lines for objcopy's --redefine-syms for one file's names.
std::string redefinitions(const std::vector<std::string>& names, const std::string& file);

/// Says, for the student, which names were made local to each file.
std::string own_names_text(const NewNames& names);

}  // namespace carlo::grader
