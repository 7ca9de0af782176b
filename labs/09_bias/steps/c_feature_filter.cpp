#include "bias.h"
#include "course/not_implemented.h"

// Lab 09, step c: a filter that knows edges. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.3 -----------------------------------------------------------------------------------------

double feature_weight(const FeaturePixel& one, const FeaturePixel& other,
                      const FilterStrength& strength) {
  // 1. Squared distances of albedos and of normals, each over twice the square of its strength.
  // 2. Depths: as a part of the larger one. What if both are 0?
  // 3. Colours, channel by channel: how far apart beyond what noise explains, in units of noise.
  //    What if there is none? Squares of colours such as 1e20 do not fit into a float.
  // 4. The weight of the sum.
  carlo::not_implemented("Lab 9.3", "Summary");
}

Filtered filter_pixel(const FeatureImage& image, int x, int y, const FilterStrength& strength) {
  // 1. All pixels up to `radius` away in x and in y that the image has.
  // 2. Each one's weight beside the pixel in the middle; sums of the weights and of the weighted
  //    colours.
  // 3. The variance of a mean with given weights: what happens to a variance when its number is
  //    multiplied?
  carlo::not_implemented("Lab 9.3", "Summary");
}

}  // namespace lab09
