#include "grader/grade/intake.h"

#include "course/verdict/printed.h"
#include "grader/grade/apart.h"
#include "grader/grade/archive.h"
#include "grader/grade/handed_in.h"
#include "grader/grade/sha256.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_source = std::size_t{1} << 20;
constexpr std::size_t most_ignored = 200;          // names that are kept
constexpr std::size_t longest_name = 300;          // in bytes, in messages
constexpr std::size_t most_looked_at = 1'000'000;  // files and folders of a submission
constexpr int deepest_archive = 2;

/// Folders that no student writes into.
const std::set<std::string> hidden_folders{".git", "__MACOSX", ".carlo"};
/// Also those that are not the student's work when a whole tree is handed in, though files with the
/// exercises' names are in them too. If nothing else was handed in, they count.
const std::set<std::string> course_folders{"solutions", "tests", "common", "build", "out"};

std::string plain_text(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r' || i + 1 == text.size() || text[i + 1] != '\n') plain += text[i];
  }
  return plain;
}

/// One candidate for an exercise file.
struct Candidate {
  std::string path, text, problem;
};

struct Collected {
  std::map<std::string, std::vector<Candidate>> candidates;  ///< by file name
  std::vector<std::string> ignored;
};

/// Collects the files of a submission.
class Collector {
 public:
  /// With `all`, also searches course_folders.
  Collector(const std::vector<CourseLab>& labs, bool all) : all_(all) {
    for (const CourseLab& lab : labs) {
      for (const std::string& file : lab.files)
        wanted_.insert(last_part(file));
    }
  }

  void folder(const fs::path& root) {
    std::set<std::string> taken, others;
    std::size_t seen = 0;
    std::error_code ec;
    for (fs::recursive_directory_iterator it(root, ec), end; it != end && !ec; it.increment(ec)) {
      const std::string path = it->path().lexically_relative(root).string();
      if (is_folder(*it)) {
        if (is_foreign_folder(it->path().filename().string()) || it.depth() > 32) {
          ignore(path + "/");
          it.disable_recursion_pending();
        }
      } else if (is_taken(path)) {
        taken.insert(path);
      } else {
        others.insert(path);
        // Keeps the names to be shown, regardless of the order in which the disk lists them.
        if (others.size() > most_ignored + 1) others.erase(std::prev(others.end()));
      }
      if (++seen > most_looked_at) {
        ignore("more files than can be looked through");
        break;
      }
    }
    // An unreadable file may be one that should be graded.
    if (ec) throw std::runtime_error(fmt::format("{}: {}", root.string(), ec.message()));
    for (const std::string& path : taken)
      disk_file(root / path, path);
    for (const std::string& path : others)
      ignore_on_disk(root / path, path);
  }

  void archive(const fs::path& file, const std::string& inside) {
    guarded(file.filename().string(), [&] {
      const auto visit = [&](const ArchiveEntry& entry) { in_part(entry, inside); };
      const auto refused = [&](const std::string& what) { ignore(what); };
      if (inside.empty()) {
        visit_archive(file, limits_, visit, refused);
      } else {
        visit_part(file, inside, limits_, visit, refused);
      }
    });
  }

  Collected collected;

 private:
  void ignore(const std::string& what) {
    std::vector<std::string>& list = collected.ignored;
    if (list.size() < most_ignored) list.push_back(clipped(harmless(what), longest_name));
    if (list.size() == most_ignored) list.push_back("and more");
  }

  /// A file that exists but cannot be read is not the student's fault: no Error, which would be
  /// reported as one.
  static std::string must_read(const fs::path& path) {
    try {
      return read_file(path);
    } catch (const Error& error) {
      throw std::runtime_error(error.what());
    }
  }

  /// A corrupt archive is the student's fault and affects only itself.
  template <class Body>
  void guarded(const std::string& path, const Body& body) {
    try {
      body();
    } catch (const Error& error) {
      ignore(fmt::format("{}: {}", path, error.what()));
    }
  }

  bool is_foreign_folder(const std::string& name) const {
    return hidden_folders.contains(name) || (!all_ && course_folders.contains(name));
  }

  bool is_in_foreign_folder(const std::string& path) const {
    for (std::size_t at = 0, slash = path.find('/'); slash != std::string::npos;
         at = slash + 1, slash = path.find('/', at)) {
      if (is_foreign_folder(path.substr(at, slash - at))) return true;
    }
    return false;
  }

  static bool is_plain_file(const fs::path& path) {
    std::error_code ec;
    return fs::symlink_status(path, ec).type() == fs::file_type::regular;
  }

  /// Returns whether a file of that path is opened, or reported as one that should be.
  bool is_taken(const std::string& path) const {
    const std::string name = last_part(path);
    return wanted_.count(name) != 0 || is_archive_name(name);
  }

  void ignore_on_disk(const fs::path& path, const std::string& name) {
    ignore(is_plain_file(path) ? name : name + ": a link or a device, not a file");
  }

  void disk_file(const fs::path& path, const std::string& name) {
    std::error_code ec;
    const auto read_whole = [&] {
      const auto bytes = fs::file_size(path, ec);
      if (ec || bytes > limits_.entry_bytes) throw Error("too large");
      use_.bytes += bytes;
      if (use_.bytes > limits_.total_bytes) throw Error("too much to read, with all before it");
      return must_read(path);
    };
    if (!is_plain_file(path)) {
      ignore(name + ": a link or a device, not a file");
    } else {
      file(name, read_whole, 0);
    }
  }

  /// Handles an entry of an archive of which only the part `inside` is the submission.
  void in_part(const ArchiveEntry& entry, const std::string& inside) {
    if (inside.empty()) {
      file(entry.path, entry.read, 0);
    } else if (entry.path == inside) {
      file(last_part(entry.path), entry.read, 0);
    } else if (entry.path.starts_with(inside + "/")) {
      file(entry.path.substr(inside.size() + 1), entry.read, 0);
    }
  }

  void file(const std::string& path, const std::function<std::string()>& read, int depth) {
    const std::string name = last_part(path);
    const bool foreign = is_in_foreign_folder(path);
    if (!foreign && wanted_.count(name) != 0) {
      guarded(path, [&] { candidate(path, read()); });
    } else if (!foreign && is_archive_name(name) && depth < deepest_archive) {
      guarded(path, [&] { nested(path, read(), depth + 1); });
    } else {
      ignore(path);
    }
  }

  void nested(const std::string& path, const std::string& bytes, int depth) {
    visit_archive(
        std::string_view(bytes), limits_,
        [&](const ArchiveEntry& entry) { file(path + "/" + entry.path, entry.read, depth); },
        [&](const std::string& what) { ignore(path + "/" + what); });
  }

  void candidate(const std::string& path, std::string text) {
    Candidate found{clipped(harmless(path), longest_name), plain_text(std::move(text)), ""};
    if (found.text.size() > largest_source) {
      found.problem = fmt::format("{}: larger than 1 MB, which no solution is", found.path);
      found.text = sha256(found.text);
    }
    // Two that differ are enough; a thousand copies would fill the memory.
    std::vector<Candidate>& list = collected.candidates[last_part(path)];
    const bool known = std::any_of(list.begin(), list.end(), [&](const Candidate& earlier) {
      return earlier.text == found.text;
    });
    if (!known && list.size() < 2) list.push_back(found);
  }

  bool all_;
  std::set<std::string> wanted_;
  // Nested archives count together: each alone may be small.
  ArchiveUse use_;
  ArchiveLimits limits_{.together = &use_};
};

/// Chooses the file of that name, or says why there is none.
void choose(const std::string& file, const std::vector<Candidate>& found, LabFiles& lab) {
  for (const Candidate& other : found) {
    if (other.text == found.front().text) continue;
    lab.problems.push_back(
        fmt::format("{} and {} differ: which one is meant?", found.front().path, other.path));
    return;
  }
  if (!found.front().problem.empty()) {
    lab.problems.push_back(found.front().problem);
  } else {
    lab.files[file] = found.front().text;
  }
}

std::string digest_of(const std::map<int, LabFiles>& labs) {
  Sha256 digest;
  for (const auto& [number, lab] : labs) {
    digest.add_text(fmt::format("lab {}", number));
    for (const auto& [name, text] : lab.files) {
      digest.add_text(name);
      digest.add_text(text);
    }
    for (const std::string& problem : lab.problems)
      digest.add_text(problem);
  }
  return digest.hex();
}

Collected collect(const Source& source, const std::vector<CourseLab>& labs, bool all) {
  Collector collector(labs, all);
  if (fs::is_directory(source.path)) {
    collector.folder(source.path);
  } else {
    collector.archive(source.path, source.inside);
  }
  return std::move(collector.collected);
}

Intake gather(const Source& source, const std::vector<CourseLab>& labs) {
  Collected collected = collect(source, labs, false);
  if (collected.candidates.empty()) collected = collect(source, labs, true);
  Intake intake;
  intake.ignored = collected.ignored;
  for (const CourseLab& lab : labs) {
    LabFiles& files = intake.labs[lab.lab.number];
    for (const std::string& file : lab.files) {
      const auto found = collected.candidates.find(last_part(file));
      if (found != collected.candidates.end()) choose(file, found->second, files);
    }
  }
  intake.digest = digest_of(intake.labs);
  return intake;
}

/// Serialises an intake as CBOR, whose texts may hold any bytes.
std::string packed(const Intake& intake) {
  nlohmann::json labs = nlohmann::json::object();
  for (const auto& [number, lab] : intake.labs)
    labs[std::to_string(number)] = {{"files", lab.files}, {"problems", lab.problems}};
  const nlohmann::json document{
      {"labs", labs}, {"ignored", intake.ignored}, {"digest", intake.digest}};
  std::string bytes;
  nlohmann::json::to_cbor(document, bytes);
  return bytes;
}

Intake unpacked(const std::string& bytes) {
  try {
    const nlohmann::json document = nlohmann::json::from_cbor(bytes);
    Intake intake;
    document.at("ignored").get_to(intake.ignored);
    document.at("digest").get_to(intake.digest);
    for (const auto& [number, lab] : document.at("labs").items()) {
      LabFiles& files = intake.labs[std::stoi(number)];
      lab.at("files").get_to(files.files);
      lab.at("problems").get_to(files.problems);
    }
    return intake;
  } catch (const std::exception& error) {
    throw Error("what was read of a submission is spoilt: {}", error.what());
  }
}

}  // namespace

Intake take_in(const Source& source, const std::vector<CourseLab>& labs) {
  if (!fs::exists(source.path)) throw Error("{} does not exist", source.path.string());
  return unpacked(apart(source.path, [&] { return packed(gather(source, labs)); }));
}

}  // namespace carlo::grader
