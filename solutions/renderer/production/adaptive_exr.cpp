#include "renderer/production/adaptive_exr.h"

#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <bit>
#include <cmath>
#include <cstdint>

namespace carlo {
namespace {

/// The values kept of a pixel's half, as doubles: three sums for each channel, the luminance and
/// `seen`, and the noise of its unit.
constexpr std::array<const char*, 5> means = {"R", "G", "B", "Y", "seen"};
constexpr std::array<const char*, 3> sums = {"sum", "squares", "samples"};
constexpr std::size_t doubles = means.size() * sums.size() + 1;

/// More than any limit of samples allows.
constexpr double most_rounds = 48;

std::string prefix(std::size_t half) {
  return fmt::format("adaptive.{}.", "AB"[half]);
}

std::vector<std::string> double_names(std::size_t half) {
  std::vector<std::string> names;
  for (const char* mean : means) {
    for (const char* sum : sums)
      names.push_back(fmt::format("{}{}.{}", prefix(half), mean, sum));
  }
  names.push_back(prefix(half) + "noise");
  return names;
}

std::string finished_name(std::size_t half) {
  return prefix(half) + "finished";
}

std::string floor_name(std::size_t half) {
  return fmt::format("adaptive_floor_{}", "AB"[half]);
}

std::array<double, doubles> to_doubles(const HalfPixel& pixel, double noise) {
  std::array<double, doubles> values{};
  for (std::size_t m = 0; m < means.size(); ++m) {
    const GroupedMean::Sums s = (m < 4 ? pixel.estimate(m) : pixel.seen()).sums();
    values[3 * m] = s.sum;
    values[3 * m + 1] = s.squares;
    values[3 * m + 2] = s.samples;
  }
  values.back() = noise;
  return values;
}

/// A double counts samples exactly up to this; a film counts them in 64 bits.
constexpr double most_samples = 0x1p53;

HalfPixel from_doubles(const std::array<double, doubles>& values, bool finished) {
  const auto mean = [&](std::size_t m) {
    const GroupedMean::Sums s{values[3 * m], values[3 * m + 1], values[3 * m + 2]};
    const bool counted =
        s.samples >= 0 && s.samples <= most_samples && s.samples == std::floor(s.samples);
    if (!counted) {
      throw Error("a pixel's half has {} samples, expected a whole number up to {}", s.samples,
                  most_samples);
    }
    if (!std::isfinite(s.sum) || !std::isfinite(s.squares) || s.squares < 0) {
      throw Error("a pixel's half has the sum {} and squared deviations {}", s.sum, s.squares);
    }
    return GroupedMean(s);
  };
  return {{mean(0), mean(1), mean(2), mean(3)}, mean(4), finished};
}

double number(const ExrFile& file, const std::string& name) {
  const auto it = file.attributes.find(name);
  const std::string text = it == file.attributes.end() ? "" : it->second;
  const std::optional<double> value = number_of<double>(text);
  if (!value || !(*value >= 0)) throw Error("its {} is '{}', expected a number", name, text);
  return *value;
}

void write_half(ExrFile& file, const AdaptiveState& state, std::size_t half) {
  const std::size_t pixels = state.halves[half].size();
  std::vector<std::vector<std::uint32_t>*> words;
  for (const std::string& name : double_names(half)) {
    for (const char* part : {".0", ".1"})
      words.push_back(&file.counts[name + part]);
  }
  std::vector<std::uint32_t>& finished = file.counts[finished_name(half)];
  for (auto* channel : words)
    channel->reserve(pixels);
  for (int y = 0; y < state.height; ++y) {
    for (int x = 0; x < state.width; ++x) {
      const HalfPixel& pixel = state.halves[half][state.pixel(x, y)];
      std::size_t i = 0;
      for (const double value :
           to_doubles(pixel, state.units[state.unit_number(x, y)].noise[half])) {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        words[i++]->push_back(static_cast<std::uint32_t>(bits));
        words[i++]->push_back(static_cast<std::uint32_t>(bits >> 32));
      }
      finished.push_back(pixel.finished() ? 1 : 0);
    }
  }
}

void read_half(const ExrFile& file, std::size_t half, AdaptiveState& state) {
  std::vector<const std::vector<std::uint32_t>*> words;
  for (const std::string& name : double_names(half)) {
    for (const char* part : {".0", ".1"})
      words.push_back(&file.counts.at(name + part));
  }
  const std::vector<std::uint32_t>& finished = file.counts.at(finished_name(half));
  for (int y = 0; y < state.height; ++y) {
    for (int x = 0; x < state.width; ++x) {
      const std::size_t pixel = state.pixel(x, y);
      std::array<double, doubles> values{};
      for (std::size_t i = 0; i < doubles; ++i) {
        values[i] = std::bit_cast<double>(std::uint64_t{(*words[2 * i + 1])[pixel]} << 32 |
                                          (*words[2 * i])[pixel]);
      }
      state.halves[half][pixel] = from_doubles(values, finished[pixel] != 0);
      AdaptiveState::Unit& unit = state.units[state.unit_number(x, y)];
      unit.noise[half] = values.back();
      unit.fell[1 - half] = finished[pixel] != 0;  // each half decides for the other
    }
  }
}

}  // namespace

std::vector<std::string> adaptive_channels() {
  std::vector<std::string> names;
  for (std::size_t half = 0; half < 2; ++half) {
    for (const std::string& name : double_names(half)) {
      names.push_back(name + ".0");
      names.push_back(name + ".1");
    }
    names.push_back(finished_name(half));
  }
  return names;
}

void add_adaptive_state(ExrFile& file, const AdaptiveState& state) {
  file.attributes["adaptive_round"] = std::to_string(state.level);
  file.attributes["adaptive_paths"] = fmt::format("{}", state.expected_paths);
  for (std::size_t half = 0; half < 2; ++half) {
    file.attributes[floor_name(half)] = fmt::format("{}", state.floors[half]);
    write_half(file, state, half);
  }
}

AdaptiveState adaptive_state_of(const ExrFile& file) {
  for (const std::string& name : adaptive_channels()) {
    if (!file.counts.contains(name)) throw Error("it lacks the channel {}", name);
  }
  AdaptiveState state(file.image.width, file.image.height);
  const double round = number(file, "adaptive_round");
  if (round > most_rounds || round != std::floor(round)) {
    throw Error("its adaptive_round is {}, expected a whole number up to {}", round, most_rounds);
  }
  state.level = static_cast<int>(round);
  state.expected_paths = number(file, "adaptive_paths");
  for (std::size_t half = 0; half < 2; ++half) {
    state.floors[half] = number(file, floor_name(half));
    read_half(file, half, state);
  }
  return state;
}

}  // namespace carlo
