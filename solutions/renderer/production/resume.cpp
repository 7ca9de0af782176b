#include "renderer/production/resume.h"

#include "course/json/json_fields.h"
#include "render/driver.h"
#include "renderer/production/adaptive_exr.h"
#include "renderer/production/block_set.h"
#include "renderer/production/exact_sum_text.h"
#include "scene/fingerprint.h"
#include "scene/sampler_kind.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// The order in which differences are reported: the most informative first.
constexpr std::array<const char*, 7> setting_names = {
    "scene_digest", "seed", "sampler", "max_depth", "planned_spp", "kernel", "definitions"};

constexpr const char* blocks_channel = "sums.blocks";

/// Names the channel with 32 of the bits of a sum, or of a sum of squares.
std::string channel_name(bool squares, std::size_t colour, std::size_t word) {
  return fmt::format("sums.{}{}{}", squares ? "squares." : "", "RGB"[colour], word);
}

std::vector<std::string> all_channels() {
  std::vector<std::string> names{blocks_channel};
  for (const bool squares : {false, true}) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t word = 0; word < ExactSum::words_count; ++word)
        names.push_back(channel_name(squares, c, word));
    }
  }
  return names;
}

std::vector<std::string> channels_of_both() {
  std::vector<std::string> names = all_channels();
  for (const std::string& name : adaptive_channels())
    names.push_back(name);
  return names;
}

void add_attributes(ExrFile& file, const RenderSettings& settings, const Counts& counts) {
  for (const auto& [name, value] : settings)
    file.attributes[name] = value;
  file.attributes["paths"] = std::to_string(counts.paths);
  file.attributes["rays"] = std::to_string(counts.rays);
  file.attributes["light_paths"] = std::to_string(counts.light_paths);
  file.attributes["light_path_ties"] = fmt::format("{}", counts.splat_covariance);
  file.attributes["cut_paths"] = std::to_string(counts.cut);
  file.attributes["bad_samples"] = std::to_string(counts.bad);
}

/// True if all pixels of each tile have the same number of blocks, as the driver leaves them.
bool even_tiles(const Film& film) {
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const int x0 = x - x % driver_tile_size, y0 = y - y % driver_tile_size;
      if (film.blocks(x, y) != film.blocks(x0, y0)) return false;
    }
  }
  return true;
}

/// The values given by -D.
struct Definitions {
  std::vector<std::string> list;
};

void fields(JsonFields& json, Definitions& definitions) {
  json("definitions", definitions.list);
}

/// The members that are read of an earlier render's report.
struct Spent {
  double seconds = 0;
  std::uint64_t samples = 0;
};

void fields(JsonFields& json, Spent& spent) {
  json("seconds", spent.seconds);
  json("samples", spent.samples);
}

}  // namespace

RenderSettings render_settings(const Scene& scene, const std::string& kernel, std::uint64_t seed,
                               std::uint32_t planned, const std::vector<std::string>& definitions) {
  return {{"scene_digest", fingerprint(scene)},
          {"seed", std::to_string(seed)},
          {"sampler", name_of(scene.sampler)},
          {"max_depth", std::to_string(scene.max_depth)},
          {"planned_spp", std::to_string(planned)},
          {"kernel", kernel},
          {"definitions", json_text(Definitions{definitions})}};
}

void add_sums(ExrFile& file, const RenderSettings& settings, const Film& film, const Counts& counts,
              const PixelCovariance& covariance) {
  add_attributes(file, settings, counts);
  if (!(covariance == PixelCovariance{})) file.attributes["pixel_tie_sums"] = to_text(covariance);
  file.attributes["block"] = std::to_string(film.block());
  const std::size_t pixels = file.image.pixels.size();
  for (const std::string& name : all_channels())
    file.counts[name].resize(pixels);
  file.counts[blocks_channel].clear();
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x)
      file.counts[blocks_channel].push_back(film.blocks(x, y));
  }
  for (const bool squares : {false, true}) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<std::vector<std::uint32_t>*, ExactSum::words_count> channels;
      for (std::size_t word = 0; word < ExactSum::words_count; ++word)
        channels[word] = &file.counts[channel_name(squares, c, word)];
      for (int y = 0; y < film.height(); ++y) {
        for (int x = 0; x < film.width(); ++x) {
          const PixelSums& sums = film.sums(x, y);
          const auto words = (squares ? sums.squares : sums.sum)[c].words();
          for (std::size_t word = 0; word < ExactSum::words_count; ++word)
            (*channels[word])[file.image.index(x, y)] = words[word];
        }
      }
    }
  }
}

void add_sums(ExrFile& file, const RenderSettings& settings, const AdaptiveState& state,
              const Counts& counts) {
  add_attributes(file, settings, counts);
  add_adaptive_state(file, state);
}

EarlierRender::EarlierRender(fs::path path)
    : path_(std::move(path)), file_(read_exr(path_, channels_of_both())) {
  const auto needed = target_error() ? adaptive_channels() : all_channels();
  bool complete = std::all_of(needed.begin(), needed.end(),
                              [&](const auto& name) { return file_.counts.contains(name); });
  for (const char* name : setting_names)
    complete = complete && file_.attributes.contains(name);
  if (!complete) {
    throw Error("cannot resume {}: it holds an image but not the sums of a render", path_.string());
  }
}

const std::string& EarlierRender::setting(const std::string& name) const {
  const auto it = file_.attributes.find(name);
  if (it == file_.attributes.end()) {
    throw Error("cannot resume {}: setting '{}' is missing", path_.string(), name);
  }
  return it->second;
}

std::uint64_t EarlierRender::number(const std::string& name) const {
  const std::string& text = setting(name);
  if (const auto value = number_of<std::uint64_t>(text)) return *value;
  throw Error("cannot resume {}: its {} is '{}', expected a whole number", path_.string(), name,
              text);
}

double EarlierRender::real(const std::string& name) const {
  const std::string& text = setting(name);
  const std::optional<double> value = number_of<double>(text);
  if (value && std::isfinite(*value)) return *value;
  throw Error("cannot resume {}: its {} is '{}', expected a number", path_.string(), name, text);
}

std::vector<std::string> EarlierRender::definitions() const {
  const std::string place = fmt::format("cannot resume {}: its definitions", path_.string());
  return from_json_text<Definitions>(setting("definitions"), place).list;
}

std::optional<double> EarlierRender::target_error() const {
  const auto it = file_.attributes.find("target_error");
  if (it == file_.attributes.end()) return std::nullopt;
  const std::optional<double> value = number_of<double>(it->second);
  if (!value || !(*value > 0)) {
    throw Error("cannot resume {}: its target_error is '{}', expected a number", path_.string(),
                it->second);
  }
  return value;
}

void EarlierRender::require_same(const RenderSettings& settings) const {
  for (const std::string name : setting_names) {
    const std::string& then = setting(name);
    const std::string& now = settings.at(name);
    // The effect of -D is already part of the scene.
    if (then == now || name == "definitions") continue;
    if (name == "scene_digest") {
      throw Error("cannot resume {}: the scene or the film has changed ({}, then {})",
                  path_.string(), now, then);
    }
    throw Error("cannot resume {}: its {} is {}, this render's {}", path_.string(), name, then,
                now);
  }
}

Film EarlierRender::film() const {
  const std::uint64_t block = number("block");
  if (block < 1 || block > 64) {
    throw Error("cannot resume {}: its block is {}, expected 1 to 64", path_.string(), block);
  }
  Film film(width(), height(), static_cast<std::uint32_t>(block));
  const auto words = [this](bool squares, std::size_t c, std::size_t pixel) {
    std::array<std::uint32_t, ExactSum::words_count> result;
    for (std::size_t word = 0; word < ExactSum::words_count; ++word)
      result[word] = file_.counts.at(channel_name(squares, c, word))[pixel];
    return ExactSum::from_words(result);
  };
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x) {
      PixelSums sums;
      const std::size_t pixel = file_.image.index(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        sums.sum[c] = words(false, c, pixel);
        sums.squares[c] = words(true, c, pixel);
      }
      sums.blocks = file_.counts.at(blocks_channel)[pixel];
      sums.samples = sums.blocks * block;
      film.set_sums(x, y, sums);
    }
  }
  if (film.mean().pixels != file_.image.pixels || !even_tiles(film)) {
    throw Error("cannot resume {}: its sums do not belong to its image", path_.string());
  }
  return film;
}

AdaptiveState EarlierRender::adaptive_state() const {
  try {
    AdaptiveState state = adaptive_state_of(file_);
    if (state.film().mean().pixels == file_.image.pixels) return state;
  } catch (const Error& e) {
    throw Error("cannot resume {}: {}", path_.string(), e.what());
  }
  throw Error("cannot resume {}: its sums do not belong to its image", path_.string());
}

Counts EarlierRender::counts() const {
  return {.paths = number("paths"),
          .rays = number("rays"),
          .light_paths = number("light_paths"),
          .cut = number("cut_paths"),
          .bad = number("bad_samples"),
          .splat_covariance = real("light_path_ties")};
}

PixelCovariance EarlierRender::covariance() const {
  if (file_.attributes.contains("light_path_tie_sum"))
    throw Error("cannot resume {}: it is of an older program, render it again", path_.string());
  const auto it = file_.attributes.find("pixel_tie_sums");
  if (it != file_.attributes.end()) {
    if (const auto sums = pixel_covariance_of(it->second)) return *sums;
    throw Error("cannot resume {}: its pixel_tie_sums are '{}', expected the words of four sums",
                path_.string(), it->second);
  }
  return {};
}

double EarlierRender::seconds(const Film& film) const {
  const fs::path report = fs::path(path_).replace_extension(".json");
  if (!fs::exists(report)) return 0;
  try {
    const auto spent = from_json_text<Spent>(read_file(report), report.string());
    return spent.samples == film.samples() ? spent.seconds : 0;
  } catch (const Error&) {
    return 0;  // another program's file of that name
  }
}

}  // namespace carlo
