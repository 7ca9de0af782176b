// Probes of lab 7's frames and samplers: 7.1 to 7.6.

#include "07_hemisphere/places.h"
#include "grader/protocol/next_words.h"
#include "grader/worker/probe.h"
#include "hemisphere.h"

using namespace lab07_tests;
using carlo::grader::Params;
using carlo::grader::RowWriter;

namespace {

/// One of the samplers of Labs 7.3 to 7.6, as requested by the check.
struct Subject {
  Sampler sampler;
  float n;
  Vec3 wo;

  explicit Subject(const Params& params)
      : sampler(static_cast<Sampler>(params.whole("sampler"))),
        n(static_cast<float>(params["exponent"])),
        wo(params["x"], params["y"], params["z"]) {}

  Vec3 sample(Vec2 u) const {
    switch (sampler) {
      case Sampler::uniform:
        return lab07::sample_uniform_hemisphere(u);
      case Sampler::cosine:
        return lab07::sample_cosine_hemisphere(u);
      case Sampler::lobe:
        return lab07::sample_lobe(u, n);
      case Sampler::mirror:
        break;
    }
    return lab07::sample_mirror_lobe(u, wo, n);
  }

  double pdf(Vec3 w) const {
    switch (sampler) {
      case Sampler::uniform:
        return lab07::uniform_hemisphere_pdf(w);
      case Sampler::cosine:
        return lab07::cosine_hemisphere_pdf(w);
      case Sampler::lobe:
        return lab07::lobe_pdf(w, n);
      case Sampler::mirror:
        break;
    }
    return lab07::mirror_lobe_pdf(w, wo, n);
  }

  /// The lobe's axis, in double; z for the others.
  Vec3 axis() const {
    return sampler == Sampler::mirror ? Vec3(-wo.x, -wo.y, wo.z) : Vec3(0, 0, 1);
  }
};

}  // namespace

PROBE("Lab 7.1 frames", "s.x", "s.y", "s.z", "t.x", "t.y", "t.z", "n.x", "n.y", "n.z", "to_world.x",
      "to_world.y", "to_world.z", "to_local.x", "to_local.y", "to_local.z",
      "(to_world of (0.3, -0.5, 0.8), to_local of (-0.6, 0.2, 0.7))") {
  RowWriter rows;
  for (const Vec3 normal : hard_normals()) {
    const lab07::Frame f(normal);
    const Vec3 world = f.to_world(frame_local), local = f.to_local(frame_world);
    rows.add({f.s.x, f.s.y, f.s.z, f.t.x, f.t.y, f.t.z, f.n.x, f.n.y, f.n.z, world.x, world.y,
              world.z, local.x, local.y, local.z});
  }
  return rows.take();
}

PROBE("Lab 7.2 directions", "x", "y", "z", "darts") {
  const Vec3 normal(params["x"], params["y"], params["z"]);
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const auto [w, darts] = lab07::sample_uniform_by_rejection(normal, rng);
    rows.add({w.x, w.y, w.z, static_cast<double>(darts)});
  }
  return rows.take();
}

PROBE("Lab 7.2 record", "darts", "x", "y", "z", "next word of rng", "next word 2", "next word 3",
      "next word 4") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const auto [w, darts] = lab07::sample_uniform_by_rejection({0, 0, 1}, rng);
    const auto next = carlo::grader::next_words(rng);
    rows.add({static_cast<double>(darts), w.x, w.y, w.z, next[0], next[1], next[2], next[3]});
  }
  return rows.take();
}

PROBE("Lab 7.3 to 7.6 directions", "x", "y", "z", "pdf") {
  const Subject subject(params);
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    const Vec3 w = subject.sample({x, y});
    rows.add({w.x, w.y, w.z, subject.pdf(w)});
  }
  return rows.take();
}

PROBE("Lab 7.3 to 7.6 edges", "x", "y", "z", "pdf",
      "(for all pairs of 10 numbers u from 0 to the last float below 1)") {
  const Subject subject(params);
  RowWriter rows;
  for (const Vec2 u : edge_numbers()) {
    const Vec3 w = subject.sample(u);
    rows.add({w.x, w.y, w.z, subject.pdf(w)});
  }
  return rows.take();
}

PROBE("Lab 7.3 to 7.5 neighbours", "x", "y", "z", "beside in u.x: x", "y", "z", "beside in u.y: x",
      "y", "z") {
  const Subject subject(params);
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    const Vec3 w = subject.sample({x, y}), beside_x = subject.sample({neighbour(x), y}),
               beside_y = subject.sample({x, neighbour(y)});
    rows.add(
        {w.x, w.y, w.z, beside_x.x, beside_x.y, beside_x.z, beside_y.x, beside_y.y, beside_y.z});
  }
  return rows.take();
}

PROBE("Lab 7.3 to 7.6 density", "pdf",
      "(in 200 rings of 32 directions, from z = 1 down to z = -1)") {
  const Subject subject(params);
  RowWriter rows;
  for (int ring = 0; ring < density_rings; ++ring) {
    for (int sector = 0; sector < density_sectors; ++sector)
      rows.add({subject.pdf(density_place(ring, sector))});
  }
  return rows.take();
}

PROBE("Lab 7.5 to 7.6 lobe density", "pdf", "(in 160 directions, from the lobe's axis outwards)") {
  const Subject subject(params);
  RowWriter rows;
  for (int step = 0; step < lobe_steps; ++step)
    rows.add({subject.pdf(lobe_direction(step, subject.n, subject.axis()))});
  return rows.take();
}

PROBE("Lab 7.6 mirror", "x", "y", "z") {
  RowWriter rows;
  for (const Vec3 wo : hard_normals()) {
    const Vec3 mirror = lab07::mirror_direction({wo.x, wo.y, std::abs(wo.z)});
    rows.add({mirror.x, mirror.y, mirror.z});
  }
  return rows.take();
}
