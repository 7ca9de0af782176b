#pragma once

#include "image/exr.h"
#include "image/film.h"
#include "numeric/exact_sum.h"
#include "render/integrator.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/part.h"
#include "renderer/production/settings.h"

#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// The state of a render in an EXR (state_exr.h). Every fault in it is an Error that names the
/// file, in one line.
class StateFile {
 public:
  /// Reads the attributes; the sums are read on request. Throws Error if it has none.
  explicit StateFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  int width() const { return width_; }
  int height() const { return height_; }

  RenderSettings settings() const { return settings_among(attributes_); }
  /// Returns a setting or another attribute. Throws Error if it is missing.
  const std::string& setting(const std::string& name) const;
  /// The same for a whole number.
  std::uint64_t number(const std::string& name) const;
  /// The same for a finite number.
  double real(const std::string& name) const;
  std::vector<std::string> definitions() const;
  /// Only adaptive renders have one.
  std::optional<double> target_error() const;
  Counts counts() const;
  /// As in RenderResult, for renders without a target error.
  ExactSum lamp_ties() const;
  /// Returns the seconds from the report beside the image; 0 if there is no report of the same
  /// render.
  double seconds(const Film& film) const;

  /// Set for a part of a render, not for a render that continues from its first samples.
  const std::optional<Part>& part() const { return part_; }
  /// The grid of the whole render that it is a part of.
  BlockGrid grid() const;

  /// Adds its sums to a film of the same size and block size. Throws Error if they are spoilt.
  void add_to(Film& film) const;
  /// Throws Error, also if the sums do not belong to the image.
  Film film() const;
  /// The same for an adaptive render.
  AdaptiveState adaptive_state() const;

 private:
  template <class... Values>
  [[noreturn]] void fail(fmt::format_string<Values...> text, Values&&... values) const;
  std::uint32_t block() const;
  void require_possible() const;
  ExrFile read() const;

  std::filesystem::path path_;
  int width_ = 0, height_ = 0;
  std::map<std::string, std::string> attributes_;
  std::optional<Part> part_;
};

}  // namespace carlo
