#pragma once

#include "image/film.h"
#include "numeric/exact_sum.h"
#include "render/driver.h"
#include "render/integrator.h"
#include "renderer/production/block_set.h"
#include "renderer/production/resume.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// Describes a part of a render.
struct PartHeader {
  /// The settings of the whole render (resume.h), and the program's "version". All parts of a
  /// render have the same.
  RenderSettings settings;
  std::string scene;                   ///< its file
  std::string needs;                   ///< describe() of the scene's needs
  BlockGrid grid;                      ///< of the whole render
  bool light_paths = false;            ///< whether light paths are traced
  double least_light_probability = 1;  ///< the integrator's
  /// The share I/N; empty for parts that were merged from different N. `index` is 0 if several
  /// shares of the same N were merged.
  std::optional<Shard> shard;
  std::uint64_t parts = 1;     ///< number of parts that were merged into it
  BlockSet blocks;             ///< the blocks that it holds
  Counts counts;               ///< except for splat_covariance
  PixelCovariance covariance;  ///< as in RenderResult
  /// Time spent; whole numbers, so that the sum does not depend on the order.
  std::uint64_t microseconds = 0;
  int threads = 1;  ///< the largest number used
};

/// The file name extension of parts.
constexpr const char* part_suffix = ".part";

/// Writes a part atomically, with those of the film's tiles that have blocks. Throws Error.
///
/// Format, little-endian: the line "carlo part 2"; length and checksum of the header; the header as
/// JSON; for each tile that has blocks a length of 32 bits and its sums (part_tile.h); length and
/// checksum of all tiles.
void write_part(const std::filesystem::path& path, const PartHeader& header, const Film& film);

/// Reads a part from a file, section by section.
class PartFile {
 public:
  /// Reads the header. Throws Error, which names the file, if it is not a part, is of another
  /// version of the format, is truncated, or has a corrupt header.
  explicit PartFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  const PartHeader& header() const { return header_; }

  /// Adds the part's sums to a film of its size and block. Throws Error if they are corrupt; the
  /// film's content is then undefined.
  void add_to(Film& film) const;

 private:
  std::filesystem::path path_;
  PartHeader header_;
  std::uint64_t first_byte_ = 0;  ///< where the sums begin
  std::uint64_t checksum_ = 0;    ///< of the sums
};

/// Returns the names of the settings in which parts of one render agree, the most informative
/// first.
std::vector<std::string> part_setting_names();

/// Returns the most informative setting in which two parts of different renders differ, and its
/// values.
struct PartDifference {
  std::string name, a, b;
};
std::optional<PartDifference> difference_of(const PartHeader& a, const PartHeader& b);

/// Describes a part: "shard 3/64", for example.
std::string describe(const PartHeader& part);

/// Returns 16 hexadecimal digits computed from the bytes of the running program's file, since a
/// program that is compiled differently may round differently. Throws Error.
std::string program_version();

}  // namespace carlo
