#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// The readers of untrusted bytes, each as a function of these bytes. Returning is correct, and so
// is carlo::Error; anything else (another exception, a signal, a sanitizer report, a second of
// processor time) is a finding.

namespace carlo::fuzz {

struct Target {
  std::string_view name;
  std::string_view reads;  ///< in words
  void (*run)(std::string_view bytes);
  std::vector<std::string> (*seeds)();  ///< what to begin with, beside files (run.sh)
};

/// Stops the program, as a finding, unless `holds`.
void require(bool holds, const char* what);

/// Writes the bytes to a file of this name, for readers that take paths. The next call overwrites
/// it.
std::filesystem::path as_file(std::string_view bytes, const std::string& name);

void read_archive(std::string_view bytes);
void read_exr(std::string_view bytes);
void read_frame(std::string_view bytes);
void read_hdr(std::string_view bytes);
void read_messages(std::string_view bytes);
void read_numbers(std::string_view bytes);
void read_obj(std::string_view bytes);
void read_params(std::string_view bytes);
void read_part(std::string_view bytes);
void read_ply(std::string_view bytes);
void read_questions(std::string_view bytes);
void read_record(std::string_view bytes);
void read_scene(std::string_view bytes);
void read_symbols(std::string_view bytes);

std::vector<std::string> exr_seeds();
std::vector<std::string> frame_seeds();
std::vector<std::string> messages_seeds();
std::vector<std::string> params_seeds();
std::vector<std::string> part_seeds();
std::vector<std::string> questions_seeds();
std::vector<std::string> record_seeds();
std::vector<std::string> symbols_seeds();

}  // namespace carlo::fuzz
