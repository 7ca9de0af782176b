#pragma once

#include "image/exr.h"
#include "image/film.h"
#include "render/driver.h"
#include "render/integrator.h"
#include "renderer/production/adaptive_state.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// The settings that determine the bits of a render besides the program: by name, as text.
using RenderSettings = std::map<std::string, std::string>;

/// `planned` is the number of samples that the integrator was made for.
RenderSettings render_settings(const Scene& scene, const std::string& kernel, std::uint64_t seed,
                               std::uint32_t planned, const std::vector<std::string>& definitions);

/// Adds to an image what continuing it needs: the settings and counts as attributes, and the film's
/// sums, which are whole numbers of 128 bits, in channels of 32 bits, so that no bit is lost.
/// `covariance` as in RenderResult.
void add_sums(ExrFile& file, const RenderSettings& settings, const Film& film, const Counts& counts,
              const PixelCovariance& covariance = {});

/// The same for an adaptive render.
void add_sums(ExrFile& file, const RenderSettings& settings, const AdaptiveState& state,
              const Counts& counts);

/// A render that was written with its sums and can be continued.
class EarlierRender {
 public:
  /// Throws Error if the file cannot be read or has no sums.
  explicit EarlierRender(std::filesystem::path path);

  int width() const { return file_.image.width; }
  int height() const { return file_.image.height; }
  const std::string& setting(const std::string& name) const;
  /// Returns a setting that is a whole number.
  std::uint64_t number(const std::string& name) const;
  /// Returns one that is a finite number.
  double real(const std::string& name) const;
  std::vector<std::string> definitions() const;
  /// Only for an adaptive render.
  std::optional<double> target_error() const;

  /// Throws Error unless these settings give the same bits.
  void require_same(const RenderSettings& settings) const;

  /// Throws Error if the sums do not belong to the image.
  Film film() const;
  /// The same for an adaptive render.
  AdaptiveState adaptive_state() const;
  Counts counts() const;
  /// As in RenderResult, for a render without a target error.
  PixelCovariance covariance() const;
  /// Returns the seconds given in the report beside the image; 0 if there is none of this render.
  double seconds(const Film& film) const;

 private:
  std::filesystem::path path_;
  ExrFile file_;
};

}  // namespace carlo
