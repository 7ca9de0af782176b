#pragma once

#include "conventions.h"

#include <string_view>

// The scenes of the rows. Where nothing else is said, the camera sees a spot of a white floor,
// whose radiance is the irradiance over pi.

namespace bench::known {

extern const Known point, far_point, sphere, disk, square, environment;
extern const Known cone;                ///< radiance 1 within 5 degrees about the zenith
extern const Known back, default_grey;  ///< two-sided, under a constant sky: its back; the default
extern const Known light_back, light_both, near_card;
extern const Known inside_sphere;
extern const Known furnace, three_segments;  ///< a cube that emits and reflects
extern const Known periscope;                ///< a light of radiance 100, seen by two mirrors
extern const Known slab, default_slab, light_inside;
extern const Known stripe, quarter, halves, fifth_row;
extern const Known phong;
extern const Known map_y_up, map_z_up, first_row, first_row_z_up, grey_map;
extern const Known spectrum, tenth;

/// A card's share of an image of 4 x 8 or 8 x 4 pixels whose `axis` sees 60 degrees.
Known framed(int width, int height, std::string_view axis);

/// The share of a Blackman-Harris filter of this radius within half a pixel of its middle.
double blackman_harris_middle(double radius);

}  // namespace bench::known
