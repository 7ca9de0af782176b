#include "grader/grade/own_names.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace carlo::grader {
namespace {

bool is_plain(const std::string& symbol) {
  return std::all_of(symbol.begin(), symbol.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '$';
  });
}

bool defines(const Symbols& symbols, const std::string& name) {
  const auto found = symbols.find(name);
  return found != symbols.end() && is_defined_once(found->second);
}

}  // namespace

NewNames own_names(const std::map<std::string, Symbols>& objects,
                   const std::map<std::string, Symbols>& stubs) {
  std::map<std::string, std::vector<std::string>> definers;
  for (const auto& [file, symbols] : objects) {
    for (const auto& [name, letters] : symbols) {
      if (is_defined_once(letters) && is_plain(name)) definers[name].push_back(file);
    }
  }
  NewNames renamed;
  for (const auto& [name, files] : definers) {
    if (files.size() < 2) continue;
    std::string owner = files.front();
    for (const std::string& file : files) {
      const auto stub = stubs.find(file);
      if (stub != stubs.end() && defines(stub->second, name)) owner = file;
    }
    for (const std::string& file : files) {
      if (file != owner) renamed[file].push_back(name);
    }
  }
  return renamed;
}

std::string redefinitions(const std::vector<std::string>& names, const std::string& file) {
  std::string suffix = ".of_";
  for (const char c : file)
    suffix += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  std::string lines;
  for (const std::string& name : names)
    lines += fmt::format("{} {}{}\n", name, name, suffix);
  return lines;
}

std::string own_names_text(const NewNames& names) {
  constexpr std::size_t shown = 10;
  std::set<std::string> all;
  for (const auto& [file, list] : names)
    all.insert(list.begin(), list.end());
  std::string text;
  std::size_t count = 0;
  for (const std::string& name : all) {
    if (count++ == shown) return text + fmt::format("and {} more\n", all.size() - shown);
    text += fmt::format(
        "{}: several files define it; each was given its own (an unnamed "
        "namespace does that)\n",
        readable(name));
  }
  return text;
}

}  // namespace carlo::grader
