#pragma once

#include "numeric/exact_sum.h"

#include <optional>
#include <string>
#include <string_view>

namespace carlo {

/// All that a sum holds: its words, in decimal.
std::string to_text(const ExactSum& sum);
/// Nothing if the text is none.
std::optional<ExactSum> exact_sum_of(std::string_view text);

}  // namespace carlo
