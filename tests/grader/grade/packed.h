#pragma once

#include "grader/grade/intake.h"
#include "support/atomic_file.h"

#include <archive.h>
#include <archive_entry.h>

#include <filesystem>
#include <string>
#include <vector>

// Submissions for tests: files and archives, in a course of two labs.

namespace carlo::grader {

inline std::vector<CourseLab> demo_labs() {
  CourseLab first{{}, "01_integration", {"integration.cpp"}};
  first.lab.number = 1;
  CourseLab eighth{{}, "08_path_tracer", {"steps/a_camera.cpp", "steps/b_direct.cpp"}};
  eighth.lab.number = 8;
  return {first, eighth};
}

inline void put(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  write_file(file, text);
}

struct Entry {
  std::string path, text;
  bool link = false;
};

/// Makes a zip in memory, with names as given.
inline std::string zip(const std::vector<Entry>& entries) {
  std::string bytes(std::size_t{8} << 20, '\0');
  std::size_t used = 0;
  archive* writer = archive_write_new();
  archive_write_set_format_zip(writer);
  archive_write_set_bytes_in_last_block(writer, 1);
  archive_write_open_memory(writer, bytes.data(), bytes.size(), &used);
  for (const Entry& each : entries) {
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, each.path.c_str());
    archive_entry_set_filetype(entry, each.link ? AE_IFLNK : AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, each.link ? 0 : static_cast<la_int64_t>(each.text.size()));
    if (each.link) archive_entry_set_symlink(entry, each.text.c_str());
    archive_write_header(writer, entry);
    if (!each.link) archive_write_data(writer, each.text.data(), each.text.size());
    archive_entry_free(entry);
  }
  archive_write_close(writer);
  archive_write_free(writer);
  bytes.resize(used);
  return bytes;
}

/// Returns the names of the submissions in `path`.
inline std::vector<std::string> submission_names(const std::filesystem::path& path,
                                                 bool one = false) {
  std::vector<std::string> list;
  for (const Source& source : find_submissions({path}, demo_labs(), one).sources)
    list.push_back(source.name);
  return list;
}

}  // namespace carlo::grader
