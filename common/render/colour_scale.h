#pragma once

#include "numeric/vec.h"

namespace carlo {

/// The colour of a value between 0 and 1, dark blue to yellow; linear RGB. The map rises in
/// brightness, and so can be read in grey and by colour-blind eyes. Values outside are clamped.
Rgb scale_colour(double t);

}  // namespace carlo
