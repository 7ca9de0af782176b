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

/// What a part of a render tells of itself.
struct PartHeader {
  /// Those of the whole render (resume.h), and the program's "version". Parts of one render agree.
  RenderSettings settings;
  std::string scene;              ///< its file
  std::string needs;              ///< describe() of its needs
  BlockGrid grid;                 ///< of the whole render
  bool light_paths = false;       ///< whether light paths are traced
  double least_light_chance = 1;  ///< the integrator's
  /// How the samples were shared out; nothing for parts that were merged from different N. `index`
  /// is 0 where shares of the same N were merged.
  std::optional<Shard> shard;
  std::uint64_t parts = 1;         ///< that were merged in it
  BlockSet blocks;                 ///< that it holds
  Counts counts;                   ///< light_path_ties apart
  ExactSum light_path_ties;        ///< as in RenderResult
  std::uint64_t microseconds = 0;  ///< that were spent: whole ones, so that their sum has no order
  int threads = 1;                 ///< at most
};

/// The ending of parts' names.
constexpr const char* part_suffix = ".part";

/// Writes a part in one step. Of the film, tiles are written that have blocks. Throws Error.
///
/// A line "carlo part 1"; the lengths of what follows and checksums; the header as JSON; the sums
/// of each tile that has any, in planes of as many bytes as the tile's numbers need (part_tile.h).
void write_part(const std::filesystem::path& path, const PartHeader& header, const Film& film);

/// A part in a file, read piece by piece.
class PartFile {
 public:
  /// Reads the header. Throws Error, which names the file, if it is no part, of another format's
  /// version, cut short, or spoilt in its header.
  explicit PartFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  const PartHeader& header() const { return header_; }

  /// Adds its sums to a film of its size and block. Throws Error if they are spoilt; what the film
  /// holds then is worthless.
  void add_to(Film& film) const;

 private:
  std::filesystem::path path_;
  PartHeader header_;
  std::uint64_t first_byte_ = 0;  ///< of the sums
  std::uint64_t checksum_ = 0;    ///< of the sums
};

/// The settings in which parts of one render agree, the most telling first.
std::vector<std::string> part_setting_names();

/// What makes two parts those of different renders: the most telling setting, and its values.
struct PartDifference {
  std::string name, a, b;
};
std::optional<PartDifference> difference_of(const PartHeader& a, const PartHeader& b);

/// "shard 3/64", or what else a part is.
std::string told(const PartHeader& part);

/// Of the program that runs: 16 hexadecimal digits from the bytes of its file, for what is compiled
/// differently may round differently. Throws Error.
std::string program_version();

}  // namespace carlo
