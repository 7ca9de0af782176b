#include "image/exr_window.h"

#include "image/image.h"
#include "support/error.h"

#include <fmt/format.h>

#include <cstdint>

namespace carlo {

ExrWindow::ExrWindow(const OIIO::ImageSpec& spec, const std::filesystem::path& path)
    : width_(spec.full_width),
      height_(spec.full_height),
      data_width_(spec.width),
      data_height_(spec.height),
      left_(std::ptrdiff_t{spec.x} - spec.full_x),
      top_(std::ptrdiff_t{spec.y} - spec.full_y) {
  if (width_ <= 0 || height_ <= 0 || std::int64_t{width_} * height_ > most_pixels) {
    throw Error("cannot read {}: its display window has {} x {} pixels, expected {} at most",
                path.string(), width_, height_, most_pixels);
  }
}

std::optional<std::size_t> ExrWindow::find(int x, int y) const {
  const std::ptrdiff_t column = x - left_, row = y - top_;
  if (column < 0 || column >= data_width_ || row < 0 || row >= data_height_) return std::nullopt;
  return static_cast<std::size_t>(row * data_width_ + column);
}

std::optional<std::string> ExrWindow::note() const {
  const bool all =
      left_ <= 0 && top_ <= 0 && left_ + data_width_ >= width_ && top_ + data_height_ >= height_;
  const bool more =
      left_ < 0 || top_ < 0 || left_ + data_width_ > width_ || top_ + data_height_ > height_;
  if (all && !more) return std::nullopt;
  return fmt::format(
      "its data window has {} x {} pixels from column {}, row {} of its display "
      "window of {} x {} on: {}{}{}",
      data_width_, data_height_, left_ + 1, top_ + 1, width_, height_,
      more ? "what is outside is left out" : "", more && !all ? ", " : "",
      all ? "" : "the rest is black");
}

}  // namespace carlo
