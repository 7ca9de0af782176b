#pragma once

#include <map>
#include <string>

namespace carlo::grader {

/// The symbols of objects and archives by their linker's names: the letters that nm gives them.
using Symbols = std::map<std::string, std::string>;

/// Adds what `nm --format=posix` printed.
void add_symbols(Symbols& symbols, const std::string& nm_output);

/// A symbol as a programmer would write it, cut to 200 letters; as it is if it would not be short.
/// In time that does not depend on who chose it.
std::string readable(const std::string& symbol);

/// Why an exercise's object may not be linked with ours; empty when it may. It defines what belongs
/// to the grader or to a library (main, write, operator new), so that our code would call the
/// student's; or it calls into the grader or the probes, whose references are answers. What headers
/// make every object define, and the lab's own namespace (`lab`: "lab01"), are no offence.
std::string foreign_symbols(const Symbols& exercise, const Symbols& ours, const std::string& lab);

}  // namespace carlo::grader
