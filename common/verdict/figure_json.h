#pragma once

#include "verdict/figure.h"

#include <nlohmann/json_fwd.hpp>

namespace carlo {

/// {"kind": "histogram" | "points" | "grid" | "listing", "title", "note", ...}. Numbers keep six
/// digits; infinities and NaN are the strings "inf", "-inf" and "nan".
nlohmann::json to_json(const Figure& figure);

/// The figure again. Throws Error when it is none, or larger than figures may be: it may come from
/// a file that somebody else wrote.
Figure figure_from_json(const nlohmann::json& json);

}  // namespace carlo
