#include "grader/grade/apart.h"
#include "grader/grade/archive.h"
#include "grader/grade/handed_in.h"
#include "grader/grade/intake.h"
#include "support/error.h"

#include <algorithm>
#include <cctype>
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

/// Returns whether a name beside submissions is clutter and not one of them.
bool is_clutter(const std::string& name) {
  return name == "__MACOSX" || name.starts_with(".");
}

/// Returns whether these paths, relative to a folder or an archive, are those of a single
/// submission: it has exercise files or labs at its top.
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
    // Corrupt: one submission, whose fault take_in() reports.
  }
  return paths;
}

/// Returns the top folder that all paths share, or "".
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

  Submissions found;

 private:
  void folder(const fs::path& path) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path))
      names.push_back(entry.path().filename().string() + (is_folder(entry) ? "/" : ""));
    std::sort(names.begin(), names.end());
    if (one_ || looks_like_one(names, labs_)) {
      if (!one_) refuse_class(path, names);
      found.sources.push_back({path.filename().string(), path});
      return;
    }
    for (std::string name : names) {
      const bool deep = name.back() == '/';
      if (deep) name.pop_back();
      if (is_clutter(name)) continue;
      if (deep || is_archive_name(name)) {
        found.sources.push_back({deep ? name : without_archive_ending(name), path / name});
      } else {
        found.left_out.push_back((path / name).string());
      }
    }
  }

  /// A class with a member that looks like a lab would be taken for one submission, together with
  /// everybody else's work.
  void refuse_class(const fs::path& path, const std::vector<std::string>& names) const {
    std::set<std::string> of_the_tree{"labs",  "steps", "common", "solutions", "tests",
                                      "build", "out",   "slides", "cmake",     "docs"};
    for (const CourseLab& lab : labs_)
      of_the_tree.insert(lab.folder);
    for (std::string name : names) {
      const bool deep = name.back() == '/';
      if (deep) name.pop_back();
      const bool lab = name.size() > 3 && std::isdigit(static_cast<unsigned char>(name[0])) != 0 &&
                       std::isdigit(static_cast<unsigned char>(name[1])) != 0 && name[2] == '_';
      if (is_clutter(name) || lab || of_the_tree.contains(name)) continue;
      if (!deep && !is_archive_name(name)) continue;
      throw Error(
          "{}: one submission, or a class? It has labs or exercise files at its top, and {} "
          "beside them: say --one, or give them a folder of their own",
          path.string(), name);
    }
  }

  void archive(const fs::path& path) {
    const std::string name = without_archive_ending(path.filename().string());
    std::vector<std::string> paths = entries_of(path);
    std::string wrapper;
    if (!one_ && !looks_like_one(paths, labs_)) wrapper = shared_folder(paths);
    if (!wrapper.empty()) paths = below(paths, wrapper);
    if (one_ || paths.empty() || looks_like_one(paths, labs_)) {
      found.sources.push_back({name, path});
      return;
    }
    std::set<std::string> parts;
    std::vector<std::string> beside;
    for (const std::string& entry : paths) {
      const std::string first = first_part(entry);
      if (is_clutter(first)) continue;
      if (first != entry || is_archive_name(first)) {
        parts.insert(first);
      } else {
        beside.push_back((path / entry).string());
      }
    }
    if (parts.empty()) {
      found.sources.push_back({name, path});
    } else {
      found.left_out.insert(found.left_out.end(), beside.begin(), beside.end());
    }
    for (const std::string& part : parts) {
      std::string inside = wrapper;
      if (!inside.empty()) inside += "/";
      inside += part;
      found.sources.push_back({without_archive_ending(part), path, inside});
    }
  }

  const std::vector<CourseLab>& labs_;
  bool one_;
};

/// Ranks claims to a name, 0 first: a folder of exactly that name, then an archive, then a name
/// that was changed to it.
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
  // The files of the class, which stand beside the submissions' folders.
  std::vector<std::string> taken{"class.csv",       "class.html",     "secret",
                                 "similarity.html", "similarity.csv", "timing.csv"};
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

Submissions find_submissions(const std::vector<fs::path>& paths, const std::vector<CourseLab>& labs,
                             bool one) {
  Finder finder(labs, one);
  for (const fs::path& path : paths)
    finder.add(path);
  if (finder.found.sources.empty()) {
    throw Error("{}: no submission in it, expected folders or archives, one a student",
                paths.empty() ? "" : paths.front().string());
  }
  name_all(finder.found.sources);
  return finder.found;
}

}  // namespace carlo::grader
