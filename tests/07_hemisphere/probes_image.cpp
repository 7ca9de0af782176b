// Probes of Lab 7.8.

#include "07_hemisphere/skies.h"
#include "grader/worker/probe.h"
#include "hemisphere.h"

using namespace lab07_tests;
using carlo::grader::Params;
using carlo::grader::RowWriter;

namespace {

lab07::ImageLight light_of(const SkyImage& image) {
  return {image.luminance, image.width, image.height};
}

SkyImage image_asked(const Params& params) {
  return sky_image(static_cast<Sky>(params.whole("sky")));
}

void add_drawn(RowWriter& rows, const lab07::ImageLight& light, glm::dvec2 u) {
  const auto [wi, pdf] = light.sample(u);
  rows.add({wi.x, wi.y, wi.z, pdf, light.pdf(wi)});
}

}  // namespace

PROBE("Lab 7.8 directions of places", "x", "y", "z") {
  RowWriter rows;
  for (const ImagePoint p : image_places()) {
    const Vec3 w = lab07::direction_at({p.x, p.y});
    rows.add({w.x, w.y, w.z});
  }
  return rows.take();
}

PROBE("Lab 7.8 places of directions", "x", "y") {
  RowWriter rows;
  for (const Vec3 w : sphere_places()) {
    const lab07::Point p = lab07::place_of(w);
    rows.add({p.x, p.y});
  }
  return rows.take();
}

PROBE("Lab 7.8 density", "pdf", "(in nine directions of each texel)") {
  const SkyImage image = image_asked(params);
  const lab07::ImageLight light = light_of(image);
  RowWriter rows;
  for (const Vec3 w : density_places(image))
    rows.add({light.pdf(w)});
  return rows.take();
}

PROBE("Lab 7.8 density at the poles", "pdf at +y", "pdf at -y") {
  const lab07::ImageLight light = light_of(image_asked(params));
  return {2, {light.pdf({0, 1, 0}), light.pdf({0, -1, 0})}};
}

PROBE("Lab 7.8 directions", "x", "y", "z", "pdf of the sample", "pdf of wi") {
  const lab07::ImageLight light = light_of(image_asked(params));
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    add_drawn(rows, light, {x, y});
  }
  return rows.take();
}

PROBE("Lab 7.8 rare texels", "x", "y", "z", "pdf of the sample", "pdf of wi",
      "(for u in the middle of what belongs to a texel; then with x and y exchanged)") {
  const SkyImage image = image_asked(params);
  const lab07::ImageLight light = light_of(image);
  RowWriter rows;
  const std::vector<TexelNumber> numbers = numbers_of_texels(image);
  for (const TexelNumber& number : numbers)
    add_drawn(rows, light, number.u);
  for (const TexelNumber& number : numbers)
    add_drawn(rows, light, {number.u.y, number.u.x});
  return rows.take();
}

PROBE("Lab 7.8 edges", "x", "y", "z", "pdf of the sample", "pdf of wi",
      "(for all pairs of 10 numbers u from 0 to the last float below 1)") {
  const lab07::ImageLight light = light_of(image_asked(params));
  RowWriter rows;
  for (const Vec2 u : edge_numbers())
    add_drawn(rows, light, u);
  return rows.take();
}
