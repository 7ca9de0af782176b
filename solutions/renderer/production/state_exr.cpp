#include "renderer/production/state_exr.h"

#include "renderer/production/adaptive_exr.h"
#include "renderer/production/digest.h"
#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace carlo {
namespace {

constexpr const char* blocks_channel = "sums.blocks";

/// The channel of 32 bits of a sum, or of a sum of squares.
std::string channel_name(bool squares, std::size_t colour, std::size_t word) {
  return fmt::format("sums.{}{}{}", squares ? "squares." : "", "RGB"[colour], word);
}

/// The channels of a sum's words.
using Channels = std::array<const std::uint32_t*, ExactSum::words_count>;

/// A range of pixels [first, end), row by row: those in the file.
struct Pixels {
  std::size_t first, end;
};
Pixels pixels_of(const ExrFile& file) {
  if (!file.lines) return {0, file.image.pixels.size()};
  return {file.image.index(0, file.lines->first), file.image.index(0, file.lines->end)};
}

/// Drops channels that are 0 in all pixels, such as the high words of sums of few blocks.
void leave_out_zeros(ExrFile& file) {
  std::erase_if(file.counts, [](const auto& channel) {
    return channel.first != blocks_channel &&
           std::all_of(channel.second.begin(), channel.second.end(),
                       [](std::uint32_t word) { return word == 0; });
  });
}

void add_attributes(ExrFile& file, const RenderSettings& settings, const Counts& counts) {
  for (const auto& [name, value] : settings) {
    if (name != "film") file.attributes[name] = value;  // already the size of the image
  }
  file.attributes["paths"] = std::to_string(counts.paths);
  file.attributes["rays"] = std::to_string(counts.rays);
  if (counts.lamp_paths > 0) {
    file.attributes["lamp_paths"] = std::to_string(counts.lamp_paths);
    file.attributes["lamp_ties"] = fmt::format("{}", counts.lamp_ties);
  }
  file.attributes["cut_paths"] = std::to_string(counts.cut);
  file.attributes["bad_samples"] = std::to_string(counts.bad);
}

}  // namespace

void add_state(ExrFile& file, const RenderSettings& settings, const Film& film,
               const Counts& counts, const ExactSum& lamp_ties) {
  add_attributes(file, settings, counts);
  if (!(lamp_ties == ExactSum{})) file.attributes["lamp_tie_sum"] = words_of(lamp_ties);
  file.attributes["block"] = std::to_string(film.block());
  for (const std::string& name : film_channels())
    file.counts[name].resize(file.image.pixels.size());
  std::vector<std::uint32_t>& blocks = file.counts.at(blocks_channel);
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x)
      blocks[file.image.index(x, y)] = film.blocks(x, y);
  }
  for (const bool squares : {false, true}) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<std::uint32_t*, ExactSum::words_count> channels;
      for (std::size_t word = 0; word < channels.size(); ++word)
        channels[word] = file.counts.at(channel_name(squares, c, word)).data();
      for (int y = 0; y < film.height(); ++y) {
        for (int x = 0; x < film.width(); ++x) {
          const PixelSums& sums = film.sums(x, y);
          const auto words = (squares ? sums.squares : sums.sum)[c].words();
          for (std::size_t word = 0; word < words.size(); ++word)
            channels[word][file.image.index(x, y)] = words[word];
        }
      }
    }
  }
  leave_out_zeros(file);
}

void add_state(ExrFile& file, const RenderSettings& settings, const AdaptiveState& state,
               const Counts& counts) {
  add_attributes(file, settings, counts);
  add_adaptive_state(file, state);
}

void add_part(ExrFile& file, const Part& part) {
  file.attributes["part"] = to_text(part);
  if (file.standard_error) return;  // not 0 on lines without samples
  // Keeps the lines that have samples, or one line if none has.
  const std::vector<std::uint32_t>& blocks = file.counts.at(blocks_channel);
  const auto any = [](std::uint32_t count) { return count > 0; };
  const auto width = file.image.width;
  const auto first = std::find_if(blocks.begin(), blocks.end(), any) - blocks.begin();
  const auto last = blocks.rend() - std::find_if(blocks.rbegin(), blocks.rend(), any);
  if (last == 0) {
    file.lines = ExrFile::Lines{0, 1};
  } else {
    file.lines =
        ExrFile::Lines{static_cast<int>(first / width), static_cast<int>((last - 1) / width) + 1};
  }
}

void seal(ExrFile& file) {
  file.attributes["digest"] = digest_of(file);
}

void write_state(const std::filesystem::path& path, ExrFile file) {
  seal(file);
  write_exr(path, file);
}

std::vector<std::string> film_channels() {
  std::vector<std::string> names{blocks_channel};
  for (const bool squares : {false, true}) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t word = 0; word < ExactSum::words_count; ++word)
        names.push_back(channel_name(squares, c, word));
    }
  }
  return names;
}

std::vector<std::string> state_channels() {
  std::vector<std::string> names = film_channels();
  for (const std::string& name : adaptive_channels())
    names.push_back(name);
  names.emplace_back("samples");
  return names;
}

std::string digest_of(const ExrFile& file) {
  const auto [first, end] = pixels_of(file);
  Digest digest;
  const auto add_image = [&, first = first, end = end](const Image& image) {
    digest.add(std::span(&image.pixels[first].x, 3 * (end - first)));
  };
  for (const auto& [name, value] : file.attributes) {
    if (name == "digest") continue;
    digest.add(name);
    digest.add(value);
  }
  add_image(file.image);
  if (file.standard_error) add_image(*file.standard_error);
  for (const auto& [name, values] : file.counts) {
    digest.add(name);
    digest.add(std::span(values).subspan(first, end - first));
  }
  return digest.text();
}

void add_film(const ExrFile& file, Film& film) {
  const std::vector<std::uint32_t> zeros(file.image.pixels.size());
  const auto channels_of = [&](bool squares, std::size_t c) {
    Channels channels;
    for (std::size_t word = 0; word < channels.size(); ++word) {
      const auto at = file.counts.find(channel_name(squares, c, word));
      channels[word] = at == file.counts.end() ? zeros.data() : at->second.data();
    }
    return channels;
  };
  const auto sum_of = [](const Channels& channels, std::size_t pixel) {
    std::array<std::uint32_t, ExactSum::words_count> words;
    for (std::size_t word = 0; word < words.size(); ++word)
      words[word] = channels[word][pixel];
    return ExactSum::from_words(words);
  };
  const std::array<Channels, 3> sums_of{channels_of(false, 0), channels_of(false, 1),
                                        channels_of(false, 2)};
  const std::array<Channels, 3> squares_of{channels_of(true, 0), channels_of(true, 1),
                                           channels_of(true, 2)};
  const std::vector<std::uint32_t>& blocks = file.counts.at(blocks_channel);
  const auto [first, end] = pixels_of(file);
  const auto width = static_cast<std::size_t>(film.width());
  for (std::size_t pixel = first; pixel < end; ++pixel) {
    if (blocks[pixel] == 0) continue;
    const auto x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
    PixelSums sums = film.sums(x, y);
    for (std::size_t c = 0; c < 3; ++c) {
      sums.sum[c].add(sum_of(sums_of[c], pixel));
      sums.squares[c].add(sum_of(squares_of[c], pixel));
    }
    sums.blocks += blocks[pixel];
    sums.samples += std::uint64_t{blocks[pixel]} * film.block();
    film.set_sums(x, y, sums);
  }
}

std::string words_of(const ExactSum& sum) {
  std::string text;
  for (const std::uint32_t word : sum.words())
    text += fmt::format("{}{}", text.empty() ? "" : " ", word);
  return text;
}

std::optional<ExactSum> sum_of_words(std::string_view text) {
  if (text.ends_with(' ')) return std::nullopt;
  std::array<std::uint32_t, ExactSum::words_count> words{};
  for (std::uint32_t& word : words) {
    const std::string_view digits = text.substr(0, text.find(' '));
    const auto value = number_of<std::uint32_t>(digits);
    if (!value) return std::nullopt;
    word = *value;
    text.remove_prefix(std::min(digits.size() + 1, text.size()));
  }
  if (!text.empty()) return std::nullopt;
  return ExactSum::from_words(words);
}

}  // namespace carlo
