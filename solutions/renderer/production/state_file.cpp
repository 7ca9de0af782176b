#include "renderer/production/state_file.h"

#include "course/json/json_fields.h"
#include "render/driver.h"
#include "renderer/production/adaptive_exr.h"
#include "renderer/production/definitions.h"
#include "renderer/production/exr_attributes.h"
#include "renderer/production/state_exr.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// Whether all pixels of each tile have the same number of blocks, as in all films of the driver.
bool even_tiles(const Film& film) {
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const int x0 = x - x % driver_tile_size, y0 = y - y % driver_tile_size;
      if (film.blocks(x, y) != film.blocks(x0, y0)) return false;
    }
  }
  return true;
}

/// The cost in an earlier render's report.
struct Spent {
  double seconds = 0;
  std::uint64_t samples = 0;
};

void fields(JsonFields& json, Spent& spent) {
  json("seconds", spent.seconds);
  json("samples", spent.samples);
}

}  // namespace

template <class... Values>
void StateFile::fail(fmt::format_string<Values...> text, Values&&... values) const {
  throw Error("cannot read {}: {}", path_.string(),
              fmt::format(text, std::forward<Values>(values)...));
}

StateFile::StateFile(fs::path path) : path_(std::move(path)) {
  ExrAttributes attributes = read_exr_attributes(path_);
  width_ = attributes.width;
  height_ = attributes.height;
  attributes_ = std::move(attributes.values);
  attributes_["film"] = film_text(width_, height_);
  const auto tells = [&](const std::string& name) { return attributes_.contains(name); };
  const std::vector<std::string>& needed = needed_settings();
  if (!std::all_of(needed.begin(), needed.end(), tells) ||
      tells("block") == tells("adaptive_round"))
    fail("it holds an image but not the sums of a render");
  if (tells("part")) part_ = part_of(setting("part"), "cannot read " + path_.string());
  require_possible();
}

/// Rejects impossible claims, because callers rely on them.
void StateFile::require_possible() const {
  if (width_ < 1 || height_ < 1 || std::int64_t{width_} * height_ > most_pixels)
    fail("its film is {} x {}", width_, height_);
  if (!part_) return;
  setting("version");
  setting("digest");
  const BlockGrid all = grid();
  if (all.passes < 1 || std::uint64_t{all.passes} * all.block != number("planned_spp"))
    fail("its blocks of {} samples are not the {} that were planned", all.block,
         setting("planned_spp"));
  if (part_->blocks.end() > all.blocks())
    fail("it has blocks up to {} of {}", part_->blocks.end(), all.blocks());
}

const std::string& StateFile::setting(const std::string& name) const {
  const auto it = attributes_.find(name);
  if (it == attributes_.end()) fail("it does not tell its {}", name);
  return it->second;
}

std::uint64_t StateFile::number(const std::string& name) const {
  const std::string& text = setting(name);
  if (const auto value = number_of<std::uint64_t>(text)) return *value;
  fail("its {} is '{}', expected a whole number", name, text);
}

double StateFile::real(const std::string& name) const {
  const std::string& text = setting(name);
  const std::optional<double> value = number_of<double>(text);
  if (value && std::isfinite(*value)) return *value;
  fail("its {} is '{}', expected a number", name, text);
}

std::vector<std::string> StateFile::definitions() const {
  return definitions_of(setting("definitions"),
                        fmt::format("cannot read {}: its definitions", path_.string()));
}

std::optional<double> StateFile::target_error() const {
  if (!attributes_.contains("target_error")) return std::nullopt;
  const double value = real("target_error");
  if (!(value > 0)) fail("its target_error is '{}', expected a number", setting("target_error"));
  return value;
}

Counts StateFile::counts() const {
  const bool lamps = attributes_.contains("lamp_paths");
  return {.paths = number("paths"),
          .rays = number("rays"),
          .lamp_paths = lamps ? number("lamp_paths") : 0,
          .cut = number("cut_paths"),
          .bad = number("bad_samples"),
          .lamp_ties = lamps ? real("lamp_ties") : 0};
}

ExactSum StateFile::lamp_ties() const {
  if (attributes_.contains("lamp_tie_sum")) {
    const std::string& text = setting("lamp_tie_sum");
    if (const auto sum = sum_of_words(text)) return *sum;
    fail("its lamp_tie_sum is '{}', expected the words of a sum", text);
  }
  // Older renders have only the rounded sum.
  ExactSum sum;
  sum.add(counts().lamp_ties * static_cast<double>(BlockGrid{width(), height()}.tiles()));
  return sum;
}

double StateFile::seconds(const Film& film) const {
  const fs::path report = fs::path(path_).replace_extension(".json");
  if (!fs::exists(report)) return 0;
  try {
    const auto spent = from_json_text<Spent>(read_file(report), report.string());
    return spent.samples == film.samples() ? spent.seconds : 0;
  } catch (const Error&) {
    return 0;  // another program's file with that name
  }
}

std::uint32_t StateFile::block() const {
  const std::uint64_t block = number("block");
  if (block < 1 || block > 64) fail("its block is {}, expected 1 to 64", block);
  return static_cast<std::uint32_t>(block);
}

BlockGrid StateFile::grid() const {
  const std::uint64_t passes = number("planned_spp") / block();
  return {width_, height_, block(),
          static_cast<std::uint32_t>(std::min<std::uint64_t>(passes, ~0u))};
}

ExrFile StateFile::read() const {
  ExrFile file = read_exr(path_, state_channels());
  if (attributes_.contains("digest") && setting("digest") != digest_of(file))
    fail("it is spoilt, or has become another meanwhile: its digest is another");
  // Where there is a digest, channels that are 0 in all pixels may be missing.
  const bool sealed = attributes_.contains("digest") && !target_error();
  for (const std::string& name : target_error() ? adaptive_channels() : film_channels()) {
    if (!file.counts.contains(name) && !(sealed && name != film_channels().front()))
      fail("it holds an image but not the sums of a render");
  }
  if (file.image.width != width_ || file.image.height != height_)
    fail("it has become another meanwhile: its film is {} x {}", file.image.width,
         file.image.height);
  return file;
}

void StateFile::add_to(Film& film) const {
  add_film(read(), film);
}

Film StateFile::film() const {
  Film film(width_, height_, block());
  const ExrFile file = read();
  add_film(file, film);
  if (film.mean().pixels != file.image.pixels || !even_tiles(film))
    fail("its sums do not belong to its image");
  return film;
}

AdaptiveState StateFile::adaptive_state() const {
  const ExrFile file = read();
  try {
    AdaptiveState state = adaptive_state_of(file);
    if (state.film().mean().pixels == file.image.pixels) return state;
  } catch (const Error& e) {
    fail("{}", e.what());
  }
  fail("its sums do not belong to its image");
}

}  // namespace carlo
