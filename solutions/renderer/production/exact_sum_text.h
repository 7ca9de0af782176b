#pragma once

#include "numeric/exact_sum.h"
#include "render/driver.h"

#include <optional>
#include <string>
#include <string_view>

namespace carlo {

/// The words of a sum, in decimal.
std::string to_text(const ExactSum& sum);
/// Nothing if the text is not of that form.
std::optional<ExactSum> exact_sum_of(std::string_view text);

/// The same for several, one after another.
std::string to_text(const PixelCovariance& covariance);
std::optional<PixelCovariance> pixel_covariance_of(std::string_view text);

}  // namespace carlo
