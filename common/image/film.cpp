#include "image/film.h"

#include "numeric/compensated.h"
#include "support/error.h"

#include <cmath>
#include <limits>

namespace carlo {
namespace {

constexpr std::int64_t max_pixels = std::int64_t{1} << 25;

void add(PixelSums& pixel, std::span<const std::array<double, 3>> means) {
  for (std::size_t c = 0; c < 3; ++c) {
    pixel.sum[c].add(means.size(), [&](std::size_t i) { return means[i][c]; });
    pixel.squares[c].add(means.size(), [&](std::size_t i) { return means[i][c] * means[i][c]; });
  }
  pixel.blocks += static_cast<std::uint32_t>(means.size());
}

}  // namespace

Film::Film(int width, int height, std::uint32_t block)
    : width_(width), height_(height), block_(block) {
  if (width < 1 || height < 1 || std::int64_t{width} * height > max_pixels) {
    throw Error("a film has 1 to {} pixels, got {} x {}", max_pixels, width, height);
  }
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

void Film::add_block(int x, int y, const std::array<double, 3>& mean) {
  add_blocks(x, y, std::span(&mean, 1));
}

void Film::add_blocks(int x, int y, std::span<const std::array<double, 3>> means) {
  PixelSums& pixel = pixels_[index(x, y)];
  add(pixel, means);
  pixel.samples += means.size() * block_;
}

void Film::set_estimate(int x, int y, const std::array<double, 3>& mean,
                        const std::array<double, 3>& standard_error, std::uint64_t samples) {
  PixelSums& pixel = pixels_[index(x, y)];
  pixel = {};
  for (const double side : {-1.0, 1.0}) {
    std::array<double, 3> block;
    for (std::size_t c = 0; c < 3; ++c)
      block[c] = mean[c] + side * standard_error[c];
    add(pixel, std::span(&block, 1));
  }
  pixel.samples = samples;
}

void Film::merge(const Film& other) {
  if (other.width_ != width_ || other.height_ != height_ || other.block_ != block_) {
    throw Error("films of different size or block cannot be merged");
  }
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      pixels_[i].sum[c].add(other.pixels_[i].sum[c]);
      pixels_[i].squares[c].add(other.pixels_[i].squares[c]);
    }
    pixels_[i].blocks += other.pixels_[i].blocks;
    pixels_[i].samples += other.pixels_[i].samples;
  }
}

double Film::mean(int x, int y, std::size_t channel) const {
  const PixelSums& pixel = pixels_[index(x, y)];
  return pixel.blocks == 0 ? 0 : pixel.sum[channel].value() / pixel.blocks;
}

double Film::variance(int x, int y, std::size_t channel) const {
  const PixelSums& pixel = pixels_[index(x, y)];
  if (pixel.blocks < 2) return std::numeric_limits<double>::infinity();
  const double n = pixel.blocks;
  const double m = pixel.sum[channel].value() / n;
  const double mean_square = pixel.squares[channel].value() / n;
  return std::fmax(0.0, mean_square - m * m) / (n - 1);
}

template <class Value>
Image Film::image_of(const Value& value) const {
  Image image(width_, height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = static_cast<float>(value(x, y, static_cast<std::size_t>(c)));
    }
  }
  return image;
}

Image Film::mean() const {
  return image_of([this](int x, int y, std::size_t c) { return mean(x, y, c); });
}

Image Film::standard_error() const {
  return image_of([this](int x, int y, std::size_t c) { return std::sqrt(variance(x, y, c)); });
}

std::uint64_t Film::samples() const {
  std::uint64_t n = 0;
  for (const PixelSums& pixel : pixels_)
    n += pixel.samples;
  return n;
}

MeanRadiance mean_radiance(const Film& film) {
  MeanRadiance result;
  for (std::size_t c = 0; c < 3; ++c) {
    double count = 0;
    CompensatedSum mean, variance;
    for (int y = 0; y < film.height(); ++y) {
      for (int x = 0; x < film.width(); ++x) {
        if (film.blocks(x, y) == 0) continue;  // an interrupted render
        ++count;
        mean.add(film.mean(x, y, c));
        variance.add(film.variance(x, y, c));
      }
    }
    result.value[c] = mean.value() / std::fmax(count, 1);
    result.standard_error[c] = std::sqrt(variance.value()) / std::fmax(count, 1);
  }
  return result;
}

}  // namespace carlo
