#pragma once

#include <map>
#include <string>

namespace carlo::grader {

/// The symbols of objects and archives: linker names with nm's letters.
using Symbols = std::map<std::string, std::string>;

/// Adds the output of `nm --format=posix`.
void add_symbols(Symbols& symbols, const std::string& nm_output);

/// Returns whether, by its letters, a symbol is defined, and not as one of many equal copies, which
/// it would replace. 'i' (chosen at run time) and 'C' (uninitialised) are definitions too.
bool is_defined_once(const std::string& letters);

/// Returns a symbol as a programmer would write it, cut to 200 letters; unchanged if that would not
/// be short. Takes bounded time for any symbol.
std::string readable(const std::string& symbol);

/// Says why an exercise's object may not be linked with ours; empty if it may. It defines what
/// belongs to the grader or to a library (main, write, operator new), so that our code would call
/// the student's; or it calls into the grader or the probes, whose references are answers. Symbols
/// that headers define in every object, and the lab's own namespace (`lab`: "lab01"), are allowed.
std::string foreign_symbols(const Symbols& exercise, const Symbols& ours, const std::string& lab);

}  // namespace carlo::grader
