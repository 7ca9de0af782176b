// Probes of exercise 9.3: they call the student's functions and return raw values;
// checks_feature_filter.cpp and checks_filter_pixel.cpp say what the values should be.

#include "09_bias/feature_data.h"
#include "bias.h"
#include "grader/worker/probe.h"

namespace {

using namespace lab09_features;

lab09::FeaturePixel feature_pixel(const Pixel& p) {
  const auto three = [](const Three& x) { return carlo::Vec3(x[0], x[1], x[2]); };
  return {three(p.color), three(p.variance), three(p.albedo), three(p.normal), p.depth};
}

lab09::FilterStrength filter_strength(const Strength& s, int radius) {
  return {radius, s.color, s.albedo, s.normal, s.depth};
}

}  // namespace

PROBE("Lab 9.3 weights", "weight", "the other way round", "with itself") {
  carlo::grader::RowWriter rows;
  for (const Pair& pair : drawn_pairs(params.seed)) {
    const lab09::FeaturePixel one = feature_pixel(pair.one), other = feature_pixel(pair.other);
    const lab09::FilterStrength strength = filter_strength(pair.strength, 3);
    rows.add({lab09::feature_weight(one, other, strength),
              lab09::feature_weight(other, one, strength),
              lab09::feature_weight(one, one, strength)});
  }
  return rows.take();
}

PROBE("Lab 9.3 pixel", "red", "green", "blue", "(second row: the variances)") {
  const PixelImage drawn = drawn_image(static_cast<ImageKind>(params.whole("kind")), params.seed);
  lab09::FeatureImage image(drawn.width, drawn.height);
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x)
      image.at(x, y) = feature_pixel(drawn.at(x, y));
  }
  const lab09::Filtered filtered = lab09::filter_pixel(
      image, static_cast<int>(params.whole("x")), static_cast<int>(params.whole("y")),
      filter_strength(drawn.strength, static_cast<int>(params.n)));
  carlo::grader::RowWriter rows;
  for (const carlo::Rgb& value : {filtered.color, filtered.variance}) {
    rows.add(
        {static_cast<double>(value.r), static_cast<double>(value.g), static_cast<double>(value.b)});
  }
  return rows.take();
}
