#include "cli/error.h"
#include "grader/grade/apart.h"
#include "grader/grade/archive.h"
#include "grader/grade/intake.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

std::string first_part(const std::string& path) {
  return path.substr(0, path.find('/'));
}

/// Names that may stand beside submissions and are none.
bool is_clutter(const std::string& name) {
  return name == "__MACOSX" || name.starts_with(".");
}

/// Whether these paths, relative to a folder or an archive, are those of a single submission: it
/// has exercise files or labs at its top.
bool looks_like_one(const std::vector<std::string>& paths, const std::vector<CourseLab>& labs) {
  std::set<std::string> files, folders{"labs", "steps"};
  for (const CourseLab& lab : labs) {
    folders.insert(lab.folder);
    for (const std::string& file : lab.files)
      files.insert(last_part(file));
  }
  return std::any_of(paths.begin(), paths.end(), [&](const std::string& path) {
    const std::string first = first_part(path);
    return first == path ? files.count(path) != 0 : folders.count(first) != 0;
  });
}

/// No name in an archive holds a zero byte.
constexpr char between_names = 0;

std::vector<std::string> entries_of(const fs::path& archive) {
  const auto names = [&] {
    std::string all;
    for (const std::string& path : archive_paths(archive))
      all += path + between_names;
    return all;
  };
  std::vector<std::string> paths;
  try {
    std::istringstream all(apart(archive, names));
    for (std::string path; std::getline(all, path, between_names);)
      paths.push_back(path);
  } catch (const Error&) {
    // Spoilt: one submission, of which take_in() says what is wrong.
  }
  return paths;
}

/// The folder that all paths share at their top, or "".
std::string shared_folder(const std::vector<std::string>& paths) {
  std::string shared;
  for (const std::string& path : paths) {
    const std::string first = first_part(path);
    if (is_clutter(first)) continue;
    if (first == path || (!shared.empty() && first != shared)) return "";
    shared = first;
  }
  return shared;
}

std::vector<std::string> below(const std::vector<std::string>& paths, const std::string& folder) {
  std::vector<std::string> list;
  for (const std::string& path : paths) {
    if (path.starts_with(folder + "/")) list.push_back(path.substr(folder.size() + 1));
  }
  return list;
}

class Finder {
 public:
  Finder(const std::vector<CourseLab>& labs, bool one) : labs_(labs), one_(one) {}

  void add(const fs::path& path) {
    std::error_code ec;
    const fs::path whole = fs::canonical(path, ec);
    if (ec) throw Error("{} does not exist", path.string());
    if (fs::is_directory(whole)) {
      folder(whole);
    } else if (is_archive_name(whole.filename().string())) {
      archive(whole);
    } else {
      throw Error("{}: neither a folder nor a .zip, .tar, .tar.gz or .tgz", path.string());
    }
  }

  std::vector<Source> sources;

 private:
  void folder(const fs::path& path) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path)) {
      const bool deep = entry.is_directory() && !entry.is_symlink();
      std::string name = entry.path().filename().string();
      if (deep) name += "/";
      names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    if (one_ || looks_like_one(names, labs_)) {
      sources.push_back({path.filename().string(), path});
      return;
    }
    for (std::string name : names) {
      const bool deep = name.back() == '/';
      if (deep) name.pop_back();
      if (is_clutter(name) || (!deep && !is_archive_name(name))) continue;
      sources.push_back({deep ? name : without_archive_ending(name), path / name});
    }
  }

  void archive(const fs::path& path) {
    const std::string name = without_archive_ending(path.filename().string());
    std::vector<std::string> paths = entries_of(path);
    std::string wrapper;
    if (!one_ && !looks_like_one(paths, labs_)) wrapper = shared_folder(paths);
    if (!wrapper.empty()) paths = below(paths, wrapper);
    if (one_ || paths.empty() || looks_like_one(paths, labs_)) {
      sources.push_back({name, path});
      return;
    }
    std::set<std::string> parts;
    for (const std::string& entry : paths) {
      const std::string first = first_part(entry);
      if (!is_clutter(first) && (first != entry || is_archive_name(first))) parts.insert(first);
    }
    if (parts.empty()) sources.push_back({name, path});
    for (const std::string& part : parts) {
      std::string inside = wrapper;
      if (!inside.empty()) inside += "/";
      inside += part;
      sources.push_back({without_archive_ending(part), path, inside});
    }
  }

  const std::vector<CourseLab>& labs_;
  bool one_;
};

/// Whether a text is UTF-8 without control characters, blanks and marks that change the direction
/// of writing (U+0080 to U+009F, U+2000 to U+206F); and without the wide forms of =, + and @, which
/// begin a formula in some spreadsheets (U+FF00 to U+FF3F), and what is no character (U+FFC0 on).
bool is_harmless_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) {
      return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
    };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    if (length == 0) return false;
    for (std::size_t k = 1; k < length; ++k) {
      if ((byte(i + k) & 0xC0) != 0x80) return false;
    }
    if (first == 0xC2 && byte(i + 1) < 0xA1) return false;
    if (first == 0xE2 && (byte(i + 1) == 0x80 || byte(i + 1) == 0x81)) return false;
    if (first == 0xEF && (byte(i + 1) == 0xBC || byte(i + 1) == 0xBF)) return false;
    i += length;
  }
  return true;
}

}  // namespace

std::string folder_name(const std::string& wanted, std::vector<std::string>& taken) {
  const bool keep_letters = is_harmless_utf8(wanted);
  std::string name;
  for (const char c : wanted.substr(0, 100)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) != 0 || c == '.' || c == '_' || c == '-';
    name += (byte < 0x80 && plain) || (byte >= 0x80 && keep_letters) ? c : '_';
  }
  while (!name.empty() && !is_harmless_utf8(name))  // cut within a letter
    name.pop_back();
  while (!name.empty() && (name.front() == '.' || name.front() == '-'))
    name.erase(0, 1);
  if (name.empty()) name = "unnamed";
  std::string unique = name;
  for (int i = 2; std::find(taken.begin(), taken.end(), unique) != taken.end(); ++i)
    unique = fmt::format("{}-{}", name, i);
  taken.push_back(unique);
  return unique;
}

namespace {

/// What is wanted comes before what only becomes it; a folder before an archive.
int claim(const Source& source) {
  std::vector<std::string> none;
  if (folder_name(source.name, none) != source.name) return 2;
  return last_part(source.handed_in()) == source.name ? 0 : 1;
}

void name_all(std::vector<Source>& sources) {
  std::vector<Source*> order;
  for (Source& source : sources)
    order.push_back(&source);
  std::stable_sort(order.begin(), order.end(),
                   [](const Source* a, const Source* b) { return claim(*a) < claim(*b); });
  std::vector<std::string> taken{"class.csv", "timing.csv", "secret"};
  for (Source* source : order) {
    std::vector<std::string> none;
    const std::string plain = folder_name(source->name, none);
    source->name = folder_name(source->name, taken);
    source->renamed = source->name != plain;
  }
}

}  // namespace

std::string Source::handed_in() const {
  const std::string file = path.filename().string();
  return inside.empty() ? file : file + "/" + inside;
}

std::vector<Source> find_submissions(const std::vector<fs::path>& paths,
                                     const std::vector<CourseLab>& labs, bool one) {
  Finder finder(labs, one);
  for (const fs::path& path : paths)
    finder.add(path);
  if (finder.sources.empty()) {
    throw Error("{}: no submission in it, expected folders or archives, one a student",
                paths.empty() ? "" : paths.front().string());
  }
  name_all(finder.sources);
  return finder.sources;
}

}  // namespace carlo::grader
