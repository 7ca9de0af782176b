#include "renderer/production/part.h"

#include "course/cli/program.h"
#include "course/json/json_fields.h"
#include "renderer/production/checksum.h"
#include "renderer/production/exact_sum_text.h"
#include "renderer/production/part_tile.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace carlo {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view part_magic = "carlo part ", part_first_line = "carlo part 2\n";
constexpr std::uint64_t most_header_bytes = std::uint64_t{1} << 26;

/// Two words of eight bytes: after the header's first line, and at the end of the file for the
/// sums.
struct Lengths {
  std::uint64_t bytes = 0, checksum = 0;
};

constexpr std::uint64_t fixed_bytes = part_first_line.size() + 2 * sizeof(Lengths);

std::uint64_t checksum_of(std::string_view text) {
  Checksum sum;
  sum.add({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
  return sum.value();
}

void write_to(std::ostream& out, const Lengths& lengths) {
  out.write(reinterpret_cast<const char*>(&lengths), sizeof lengths);
}

Lengths lengths_at(std::istream& in, std::uint64_t byte) {
  Lengths lengths;
  in.seekg(static_cast<std::streamoff>(byte));
  in.read(reinterpret_cast<char*>(&lengths), sizeof lengths);
  return lengths;
}

/// Reads or writes a member that is stored as text.
template <class T, class Write, class Read>
void as_words(JsonFields& json, const char* name, T& value, Write write, Read read) {
  std::string text = json.reading() ? "" : write(value);
  json(name, text);
  if (!json.reading()) return;
  const auto found = read(text);
  if (!found) json.fail(fmt::format("its {} is '{}'", name, text));
  value = *found;
}

void whole(JsonFields& json, const char* name, std::uint32_t& value) {
  unsigned long number = value;
  json(name, number);
  if (number > 0xFFFFFFFF) json.fail(fmt::format("its {} is {}", name, number));
  value = static_cast<std::uint32_t>(number);
}

/// Throws unless a header's claims are possible, since other code relies on them.
void require_possible(const PartHeader& part, const fs::path& path) {
  const auto fail = [&](const std::string& what) {
    throw Error("cannot read {}: {}", path.string(), what);
  };
  for (const std::string& name : part_setting_names()) {
    if (!part.settings.contains(name)) fail(fmt::format("setting '{}' is missing", name));
  }
  const BlockGrid& grid = part.grid;
  if (grid.width < 1 || grid.height < 1 || std::int64_t{grid.width} * grid.height > most_pixels ||
      grid.block < 1 || grid.block > 64 || grid.passes < 1) {
    fail(fmt::format("its film is {} x {}, {} blocks of {} samples", grid.width, grid.height,
                     grid.passes, grid.block));
  }
  const auto planned = number_of<std::uint64_t>(part.settings.at("planned_spp"));
  if (planned != std::uint64_t{grid.passes} * grid.block) {
    fail(fmt::format("its {} blocks of {} samples are not the {} that were planned", grid.passes,
                     grid.block, part.settings.at("planned_spp")));
  }
  if (!(part.least_light_probability >= 0 && part.least_light_probability <= 1)) {
    fail(fmt::format("least_light_chance is {}", part.least_light_probability));
  }
  if (part.blocks.end() > grid.blocks()) {
    fail(fmt::format("it has blocks up to {} of {}", part.blocks.end(), grid.blocks()));
  }
  if (part.shard && (part.shard->count < 1 || part.shard->count > most_shards ||
                     part.shard->index > part.shard->count)) {
    fail(fmt::format("it is shard {}", part.shard->text()));
  }
}

/// Calls visit(x0, y0, x1, y1, blocks) for each tile that has any, in order.
template <class Visit>
void for_each_tile(const PartHeader& part, Visit visit) {
  const BlockGrid& grid = part.grid;
  const std::vector<std::uint32_t> blocks = part.blocks.of_tiles(grid.tiles());
  std::size_t tile = 0;
  for (int y = 0; y < grid.height; y += driver_tile_size) {
    for (int x = 0; x < grid.width; x += driver_tile_size, ++tile) {
      if (blocks[tile] == 0) continue;
      visit(x, y, std::min(x + driver_tile_size, grid.width),
            std::min(y + driver_tile_size, grid.height), blocks[tile]);
    }
  }
}

std::vector<PixelSums> pixels_of(const Film& film, int x0, int y0, int x1, int y1) {
  std::vector<PixelSums> pixels;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x)
      pixels.push_back(film.sums(x, y));
  }
  return pixels;
}

}  // namespace

static void fields(JsonFields& json, BlockGrid& grid) {
  json("width", grid.width);
  json("height", grid.height);
  whole(json, "block", grid.block);
  whole(json, "passes", grid.passes);
}

static void fields(JsonFields& json, Shard& shard) {
  whole(json, "index", shard.index);
  whole(json, "count", shard.count);
}

static void fields(JsonFields& json, Counts& counts) {
  json.as_text("paths", counts.paths);
  json.as_text("rays", counts.rays);
  json.as_text("light_paths", counts.light_paths);
  json.as_text("cut_paths", counts.cut);
  json.as_text("bad_samples", counts.bad);
}

static void fields(JsonFields& json, PartHeader& part) {
  json("scene", part.scene);
  json("needs", part.needs);
  json("settings", part.settings);
  json("grid", part.grid);
  json("light_paths", part.light_paths);
  json("least_light_chance", part.least_light_probability);
  json("shard", part.shard);
  json.as_text("parts", part.parts);
  as_words(
      json, "blocks", part.blocks, [](const BlockSet& set) { return set.text(); },
      [](const std::string& text) { return BlockSet::from_text(text); });
  json("counts", part.counts);
  as_words(
      json, "pixel_ties", part.covariance,
      [](const PixelCovariance& covariance) { return to_text(covariance); },
      [](const std::string& text) { return pixel_covariance_of(text); });
  json.as_text("microseconds", part.microseconds);
  json("threads", part.threads);
}

std::vector<std::string> part_setting_names() {
  // Settings that the scene's digest depends on come before it; those that depend on it, after.
  return {"seed",         "sampler", "max_depth", "planned_spp",
          "scene_digest", "kernel",  "version",   "definitions"};
}

void write_part(const fs::path& path, const PartHeader& header, const Film& film) {
  AtomicFile file(path);
  std::ofstream out(file.path(), std::ios::binary);
  const std::string text = json_text(header);
  out << part_first_line;
  write_to(out, {text.size(), checksum_of(text)});
  out << text;
  Lengths body;
  Checksum checksum;
  std::vector<unsigned char> bytes;
  for_each_tile(header, [&](int x0, int y0, int x1, int y1, std::uint32_t) {
    bytes.assign(sizeof(std::uint32_t), 0);
    append_tile(bytes, pixels_of(film, x0, y0, x1, y1));
    const auto length = static_cast<std::uint32_t>(bytes.size() - sizeof(std::uint32_t));
    std::memcpy(bytes.data(), &length, sizeof length);
    checksum.add(bytes);
    body.bytes += bytes.size();
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  });
  body.checksum = checksum.value();
  write_to(out, body);
  out.close();
  if (!out) throw Error("cannot write {}: is the disk full?", path.string());
  file.commit();
}

PartFile::PartFile(fs::path path) : path_(std::move(path)) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(path_, none);
  std::ifstream in(path_, std::ios::binary);
  if (none || !in) throw Error("cannot read {}: there is no such file", path_.string());
  std::string line(std::min<std::uintmax_t>(size, part_first_line.size()), '\0');
  in.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (!line.starts_with(part_magic)) {
    throw Error("cannot read {}: it is no part of a render, as --shard writes them",
                path_.string());
  }
  if (line.size() == part_first_line.size() && line != part_first_line) {
    throw Error("cannot read {}: it is a part by another version of Carlo ('{}')", path_.string(),
                line.substr(0, line.find('\n')));
  }
  const Error cut("cannot read {}: it is cut short, or something was added: it has {} bytes",
                  path_.string(), size);
  if (size < fixed_bytes) throw Error(cut);
  const Lengths head = lengths_at(in, part_first_line.size());
  if (head.bytes > most_header_bytes) {
    throw Error("cannot read {}: corrupt: its header claims {} bytes", path_.string(), head.bytes);
  }
  if (size < fixed_bytes + head.bytes) throw Error(cut);
  std::string text(head.bytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in || checksum_of(text) != head.checksum) {
    throw Error("cannot read {}: corrupt: header checksum mismatch", path_.string());
  }
  header_ = from_json_text<PartHeader>(text, fmt::format("cannot read {}", path_.string()));
  require_possible(header_, path_);
  const Lengths body = lengths_at(in, size - sizeof(Lengths));
  // A truncated file does not end in lengths, but in arbitrary bytes.
  if (!in || body.bytes != size - fixed_bytes - head.bytes) throw Error(cut);
  first_byte_ = part_first_line.size() + sizeof(Lengths) + head.bytes;
  checksum_ = body.checksum;
}

void PartFile::add_to(Film& film) const {
  std::ifstream in(path_, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(first_byte_));
  const Error spoilt("cannot read {}: corrupt: checksum mismatch in the sums", path_.string());
  Checksum checksum;
  std::vector<unsigned char> bytes;
  for_each_tile(header_, [&](int x0, int y0, int x1, int y1, std::uint32_t blocks) {
    std::vector<PixelSums> pixels = pixels_of(film, x0, y0, x1, y1);
    std::uint32_t length = 0;
    in.read(reinterpret_cast<char*>(&length), sizeof length);
    if (!in || length > most_tile_bytes(pixels.size())) throw Error(spoilt);
    bytes.resize(sizeof length + length);
    std::memcpy(bytes.data(), &length, sizeof length);
    in.read(reinterpret_cast<char*>(&bytes[sizeof length]), length);
    if (!in || !add_tile(std::span(bytes).subspan(sizeof length), pixels)) throw Error(spoilt);
    checksum.add(bytes);
    std::size_t i = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x, ++i) {
        pixels[i].blocks += blocks;
        pixels[i].samples += std::uint64_t{blocks} * film.block();
        film.set_sums(x, y, pixels[i]);
      }
    }
  });
  if (checksum.value() != checksum_) throw Error(spoilt);
}

std::optional<PartDifference> difference_of(const PartHeader& a, const PartHeader& b) {
  const auto film = [](const BlockGrid& grid) {
    return fmt::format("{} x {} in {} blocks of {}", grid.width, grid.height, grid.passes,
                       grid.block);
  };
  for (const std::string& name : part_setting_names()) {
    if (name == "scene_digest" && a.grid != b.grid)
      return PartDifference{"film", film(a.grid), film(b.grid)};
    // The effect of -D is already part of the scene.
    if (name == "definitions" || a.settings.at(name) == b.settings.at(name)) continue;
    return PartDifference{name == "scene_digest" ? "scene" : name, a.settings.at(name),
                          b.settings.at(name)};
  }
  return std::nullopt;
}

std::string describe(const PartHeader& part) {
  if (part.shard && part.shard->index > 0) return "shard " + part.shard->text();
  return fmt::format("{} merged parts", part.parts);
}

std::string program_version() {
  const std::string path = own_path();
  std::ifstream in(path, std::ios::binary);
  Checksum checksum;
  std::vector<unsigned char> bytes(1 << 20);
  while (in) {
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    checksum.add(std::span(bytes).first(static_cast<std::size_t>(in.gcount())));
  }
  if (!in.eof()) throw Error("cannot read {}, the program itself, to tell its version", path);
  return fmt::format("{:016x}", checksum.value());
}

}  // namespace carlo
