#include "course/guide/own_files.h"

#include "random/hash.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>
#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;

std::string digest_of(const std::string& text) {
  return fmt::format("{:016x}", hash_of(text));
}

/// Returns "Lab 1.2" for a heading "// Lab 1.2 ----", else "".
std::string heading_of(const std::string& line) {
  constexpr std::string_view start = "// Lab ";
  if (line.rfind(start, 0) != 0) return "";
  const std::size_t end = line.find_first_not_of("0123456789.", start.size());
  const std::string number = line.substr(start.size(), end - start.size());
  const bool closed = end == std::string::npos || line[end] == ' ' || line[end] == '\r';
  const std::size_t point = number.find('.');
  const bool dotted = point != std::string::npos && point > 0 && point + 1 < number.size();
  return closed && dotted ? "Lab " + number : "";
}

std::string text_of(const fs::path& file) {
  try {
    return read_file(file);
  } catch (const Error&) {
    return "";
  }
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++found;
  return found;
}

/// Removes // comments, so that a call that is commented out does not count.
std::string without_comments(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    out += line.substr(0, line.find("//")) + "\n";
  return out;
}

/// A line that cannot affect exercises further down, such as a library's #include.
bool means_nothing(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos || line.rfind("#include <", 0) == 0;
}

}  // namespace

std::vector<fs::path> own_files(const fs::path& labs, const Lab& lab) {
  const fs::path folder = labs / fmt::format("{:02}_{}", lab.number, lab.name);
  std::vector<fs::path> files;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder / "steps", ec)) {
    const fs::path& file = entry.path();
    // Editors keep copies under names that begin with a dot.
    if (file.extension() == ".cpp" && file.filename().string().front() != '.') {
      files.push_back(file);
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) files.push_back(folder / (lab.name + ".cpp"));
  return files;
}

bool is_own_file(const fs::path& relative) {
  std::vector<std::string> parts;
  for (const fs::path& part : relative)
    parts.push_back(part.string());
  if (parts.size() < 3 || parts[0] != "labs" || relative.extension() != ".cpp") return false;
  if (parts.size() == 4) return parts[2] == "steps";
  return parts.size() == 3 && parts[1].size() > 3 && parts[1].substr(3) + ".cpp" == parts[2];
}

OwnCode::OwnCode(const fs::path& labs, const Lab& lab) : lab_(&lab) {
  for (const fs::path& file : own_files(labs, lab)) {
    const std::string text = text_of(file);
    all_ += text;
    read(text);
  }
}

void OwnCode::read(const std::string& text) {
  std::string shared, tag;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (std::string heading = heading_of(line); !heading.empty()) {
      tag = std::move(heading);
      parts_[tag].shared = shared;
    }
    if (tag.empty() && means_nothing(line)) continue;
    (tag.empty() ? shared : parts_[tag].text) += line + "\n";
  }
}

std::string OwnCode::digest() const {
  return digest_of(all_);
}

std::string OwnCode::digest(const Exercise& exercise) const {
  const auto part = parts_.find(exercise.tag);
  if (part == parts_.end()) return digest();
  std::string text = part->second.shared + part->second.text;
  for (const std::string& tag : exercise.uses) {
    const Exercise* used = lab_->find(tag);
    if (used != nullptr) text += digest(*used);
  }
  return digest_of(text);
}

int OwnCode::open_functions(const Exercise& exercise) const {
  return count(without_comments(all_), fmt::format("not_implemented(\"{}\"", exercise.tag));
}

std::vector<const Exercise*> OwnCode::changed_since(const OwnCode& before) const {
  std::vector<const Exercise*> changed;
  for (const Exercise& exercise : lab_->exercises) {
    const auto now = parts_.find(exercise.tag), then = before.parts_.find(exercise.tag);
    if (now == parts_.end() || then == before.parts_.end()) continue;
    if (now->second.text != then->second.text) changed.push_back(&exercise);
  }
  return changed;
}

}  // namespace carlo
