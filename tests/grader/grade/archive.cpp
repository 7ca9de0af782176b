#include "grader/grade/archive.h"

#include "support/error.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;
using Visitor = std::function<void(const ArchiveEntry&)>;
using Refusal = std::function<void(const std::string&)>;

struct Closer {
  void operator()(archive* reader) const { archive_read_free(reader); }
};
using Reader = std::unique_ptr<archive, Closer>;

std::string reason(archive* reader) {
  const char* text = archive_error_string(reader);
  return text == nullptr ? "spoilt" : text;
}

/// A faulty archive is its author's fault, and an Error; a failure on our side is not.
[[noreturn]] void fail(archive* reader, const std::string& what) {
  static const std::set<int> of_the_machine{EACCES, EPERM,  EIO,    ENOMEM, EMFILE,
                                            ENFILE, ENOENT, ESTALE, EINTR,  EAGAIN};
  const std::string words = what + reason(reader);
  if (of_the_machine.contains(archive_errno(reader))) throw std::runtime_error(words);
  throw Error("{}", words);
}

/// Accepts only formats that students' machines make: strangers' bytes reach fewer parsers.
Reader make_reader() {
  Reader reader(archive_read_new());
  if (!reader) throw std::runtime_error("out of memory");
  archive_read_support_format_zip(reader.get());
  archive_read_support_format_tar(reader.get());
  archive_read_support_filter_gzip(reader.get());
  return reader;
}

Reader reader_of(const fs::path& file) {
  Reader reader = make_reader();
  if (archive_read_open_filename(reader.get(), file.c_str(), 65536) != ARCHIVE_OK) {
    fail(reader.get(), "no zip or tar archive: ");
  }
  return reader;
}

/// Returns the path with slashes and without empty and "." parts; none if it leads out of the
/// archive.
std::optional<std::string> safe_path(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  if (path.empty() || path.front() == '/' || (path.size() > 1 && path[1] == ':')) return {};
  std::string safe;
  int depth = 0;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    const std::string part = path.substr(at, end - at);
    at = end + 1;
    if (part == ".." || ++depth > 64) return {};
    if (part.empty() || part == ".") continue;
    safe += (safe.empty() ? "" : "/") + part;
  }
  if (safe.empty()) return {};
  return safe;
}

/// Reads one archive and counts what it unpacks.
class EntryWalk {
 public:
  EntryWalk(archive* reader, const ArchiveLimits& limits)
      : reader_(reader), limits_(limits), use_(limits.together ? *limits.together : own_) {}

  void all(const Visitor& visit, const Refusal& refused) {
    archive_entry* entry = nullptr;
    while (next(entry)) {
      if (++use_.entries > limits_.entries) throw Error("more than {} files", limits_.entries);
      one(entry, visit, refused);
    }
  }

  void part(const std::string& part, const Visitor& visit, const Refusal& refused) {
    archive_entry* entry = nullptr;
    while (next(entry)) {
      const std::optional<std::string> path = safe_path(given_path(entry));
      if (!path || (*path != part && !path->starts_with(part + "/"))) continue;
      if (++use_.entries > limits_.entries) throw Error("more than {} files", limits_.entries);
      one(entry, visit, refused);
    }
  }

  std::vector<std::string> paths() {
    std::vector<std::string> paths;
    archive_entry* entry = nullptr;
    while (next(entry)) {
      if (!is_file(entry)) continue;
      if (std::optional<std::string> path = safe_path(given_path(entry))) paths.push_back(*path);
    }
    return paths;
  }

 private:
  bool next(archive_entry*& entry) {
    const int status = archive_read_next_header(reader_, &entry);
    if (status == ARCHIVE_EOF) return false;
    if (status != ARCHIVE_OK && status != ARCHIVE_WARN) fail(reader_, "");
    return true;
  }

  static std::string given_path(archive_entry* entry) {
    const char* name = archive_entry_pathname_utf8(entry);
    if (name == nullptr) name = archive_entry_pathname(entry);
    return name == nullptr ? "" : name;
  }

  static bool is_file(archive_entry* entry) {
    return archive_entry_hardlink(entry) == nullptr && archive_entry_filetype(entry) == AE_IFREG;
  }

  void one(archive_entry* entry, const Visitor& visit, const Refusal& refused) {
    if (archive_entry_filetype(entry) == AE_IFDIR) return;
    const std::string given = given_path(entry);
    const std::optional<std::string> path = safe_path(given);
    if (!path) {
      refused(fmt::format("{}: leads out of the archive", given));
    } else if (!is_file(entry)) {
      refused(fmt::format("{}: a link or a device, not a file", *path));
    } else {
      visit({*path, [this] { return read(); }});
    }
    skip_rest();
  }

  std::string read() {
    std::string bytes;
    take([&](const char* data, std::size_t size) {
      bytes.append(data, size);
      if (bytes.size() > limits_.entry_bytes) {
        throw Error("more than {} MB in one file", limits_.entry_bytes >> 20);
      }
    });
    return bytes;
  }

  /// Unread data is unpacked too, so that it counts: a small archive may unpack to more than any
  /// disk holds.
  void skip_rest() {
    take([](const char*, std::size_t) {});
  }

  template <class Take>
  void take(const Take& piece) {
    std::array<char, 65536> block{};
    while (true) {
      const la_ssize_t got = archive_read_data(reader_, block.data(), block.size());
      if (got < 0) fail(reader_, "");
      if (got == 0) return;
      use_.bytes += static_cast<std::size_t>(got);
      if (use_.bytes > limits_.total_bytes) {
        throw Error("it unpacks to more than {} MB", limits_.total_bytes >> 20);
      }
      piece(block.data(), static_cast<std::size_t>(got));
    }
  }

  archive* reader_;
  ArchiveLimits limits_;
  ArchiveUse own_;
  ArchiveUse& use_;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Returns the ending that identifies an archive, or "".
std::string archive_ending(const std::string& name) {
  const std::string small = lower(name);
  for (const char* ending : {".tar.gz", ".tgz", ".tar", ".zip"}) {
    if (small.ends_with(ending) && small.size() > std::string_view(ending).size()) return ending;
  }
  return "";
}

}  // namespace

void visit_archive(const fs::path& file, const ArchiveLimits& limits, const Visitor& visit,
                   const Refusal& refused) {
  EntryWalk(reader_of(file).get(), limits).all(visit, refused);
}

void visit_part(const fs::path& file, const std::string& part, const ArchiveLimits& limits,
                const Visitor& visit, const Refusal& refused) {
  EntryWalk(reader_of(file).get(), limits).part(part, visit, refused);
}

std::vector<std::string> archive_paths(const fs::path& file) {
  return EntryWalk(reader_of(file).get(), {}).paths();
}

void visit_archive(std::string_view bytes, const ArchiveLimits& limits, const Visitor& visit,
                   const Refusal& refused) {
  const Reader reader = make_reader();
  if (archive_read_open_memory(reader.get(), bytes.data(), bytes.size()) != ARCHIVE_OK) {
    fail(reader.get(), "no zip or tar archive: ");
  }
  EntryWalk(reader.get(), limits).all(visit, refused);
}

bool is_archive_name(const std::string& name) {
  return !archive_ending(name).empty();
}

std::string without_archive_ending(const std::string& name) {
  return name.substr(0, name.size() - archive_ending(name).size());
}

}  // namespace carlo::grader
