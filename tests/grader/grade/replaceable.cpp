#include "grader/grade/replaceable.h"

#include "grader/grade/compilation.h"
#include "grader/grade/foreign_symbols.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> replaceable_flags{"-fPIC", "-fsemantic-interposition"};
/// With them the linker leaves out what is not called.
const std::vector<std::string> solution_flags{"-ffunction-sections", "-fdata-sections"};
const std::vector<std::string> link_flags{"-Wl,--gc-sections"};

/// Returns a name as the C++ ABI writes it: its length, then itself.
std::string mangled(const std::string& name) {
  return std::to_string(name.size()) + name;
}

/// Returns the names, one a line, of definitions that `chosen` takes.
template <class Chosen>
std::string lines_of(const Symbols& symbols, const Chosen& chosen) {
  std::string lines;
  for (const auto& [symbol, letters] : symbols) {
    if (is_defined_once(letters) && chosen(symbol)) lines += symbol + "\n";
  }
  return lines;
}

fs::path made_folder(const fs::path& folder) {
  fs::create_directories(folder);
  fs::permissions(folder, fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
  return folder;
}

/// Returns a new copy of an object, readable as it is.
fs::path copied(const fs::path& object, const fs::path& folder, const std::string& name) {
  fs::path copy = folder / (name + object.filename().string());
  fs::copy_file(object, copy, fs::copy_options::overwrite_existing);
  return copy;
}

}  // namespace

bool is_symbol_of(const std::string& symbol, const std::string& name_space,
                  const std::string& function) {
  std::string path = mangled(name_space), last, before;
  for (std::size_t at = 0; at < function.size();) {
    const std::size_t end = std::min(function.find("::", at), function.size());
    before = last;
    last = function.substr(at, end - at);
    const bool constructs = !before.empty() && last == before;
    path += constructs ? "C" : mangled(last);
    at = end + 2;
  }
  for (const char* start : {"_ZN", "_ZNK"}) {
    if (!symbol.starts_with(start + path)) continue;
    const std::string rest = symbol.substr((start + path).size());
    // A constructor has a digit for its kind; a function may have a tag of the standard library's.
    return path.back() == 'C' ? rest.size() > 1 && rest[1] == 'E'
                              : rest.starts_with("E") || rest.starts_with("B5cxx11E");
  }
  return false;
}

ReplaceableCode::ReplaceableCode(const std::map<std::string, std::string>& files,
                                 const LabTools& tools, const Sandbox& sandbox,
                                 const Folders& folders)
    : tools_(tools),
      sandbox_(sandbox),
      folders_{made_folder(folders.ours / "replaceable"), folders.theirs},
      objects_(compile_objects(files, tools, sandbox, folders_, replaceable_flags)) {}

bool ReplaceableCode::is_one_of(const std::string& symbol,
                                const std::vector<std::string>& functions) const {
  return std::any_of(functions.begin(), functions.end(), [&](const std::string& function) {
    return is_symbol_of(symbol, tools_.name_space, function);
  });
}

fs::path ReplaceableCode::solution_object(const std::string& file, const std::string& text) {
  const fs::path name = fs::path(file).filename().string() + ".o";
  fs::path object = tools_.solution_objects / name;
  if (fs::exists(object)) return object;
  // Whichever submission needs it first makes it for all.
  const fs::path own = folders_.ours / ("new_" + name.string());
  Compilation compilation(tools_, sandbox_, folders_.theirs, solution_flags);
  std::string said;
  if (!compilation.make(file, text, own, said))
    throw Error("the solution of {} cannot be compiled in the sandbox: {}", file,
                said.substr(0, said.find('\n')));
  fs::rename(own, object);
  return object;
}

void ReplaceableCode::link(const std::vector<std::string>& functions, const fs::path& worker) {
  Compilation compilation(tools_, sandbox_, folders_.theirs, link_flags);
  const auto replaced = [&](const std::string& symbol) { return is_one_of(symbol, functions); };
  const auto others = [&](const std::string& symbol) { return !replaced(symbol); };
  std::vector<fs::path> objects, copies;
  for (const auto& [name, object] : objects_.value()) {
    objects.push_back(copied(object, folders_.ours, "student_"));
    const Symbols symbols = compilation.symbols_of(object);
    compilation.change_symbols(objects.back(), "--weaken-symbols", lines_of(symbols, replaced));
  }
  for (const auto& [file, text] : tools_.solutions) {
    const fs::path copy = copied(solution_object(file, text), folders_.ours, "solution_");
    copies.push_back(copy);
    const Symbols symbols = compilation.symbols_of(copy);
    if (lines_of(symbols, replaced).empty()) continue;
    objects.push_back(copy);
    compilation.change_symbols(copy, "--localize-symbols", lines_of(symbols, others));
  }
  std::string said;
  const bool linked = compilation.link(objects, worker, said);
  // The worker could find them beside itself.
  for (const fs::path& copy : copies)
    fs::remove(copy);
  if (!linked)
    throw Error("the second worker cannot be linked: {}", said.substr(0, said.find('\n')));
}

}  // namespace carlo::grader
