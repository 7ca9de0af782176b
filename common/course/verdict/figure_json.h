#pragma once

#include "course/json/json_fields.h"
#include "course/verdict/figure.h"

namespace carlo {

/// "kind" is "histogram", "points", "grid" or "listing"; numbers keep six digits. Reading throws
/// Error for a figure above the size limits: it may come from a file that somebody else wrote.
void fields(JsonFields& json, Figure& figure);

}  // namespace carlo
