#pragma once

#include "numeric/vec.h"
#include "renderer/lanes/lane_kernel.h"

#include <catch2/catch_test_macros.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace instruction_sets {

/// Runs the check with each of the kernel's instruction sets on this machine.
template <class Check>
void on_all(const Check& check) {
  for (const std::string& name : renderer::lane_instruction_sets()) {
    renderer::use_instruction_set(name);
    INFO(name);
    check();
  }
  renderer::use_instruction_set("");
}

}  // namespace instruction_sets

// What tests of the vector kernel compute on each instruction set: their files are compiled once
// for each.

namespace renderer {

/// Choices of a light for one point each: the random numbers, which light with what probability and
/// what remains of u; then the probability as it is computed for a light that is known.
struct LightChoices {
  std::vector<float> px, py, pz, nx, ny, nz, u;
  std::vector<std::uint32_t> word, light;
  std::vector<float> probability, again;
};

/// Sample points at places of a scene, on surfaces of normal n; then the place of each as the lanes
/// number it, and the guided points with one over their density.
struct GuidedSamples {
  std::vector<float> px, py, pz, nx, ny, nz, x, y;
  std::vector<std::uint32_t> place;
  std::vector<float> guided_x, guided_y, per_density;
};

/// A ray's origin, direction and length, the surface that it starts on and the way to there; then
/// what it meets, and whether something blocks it.
struct TriedRay {
  std::array<float, 3> o, d, arrival;
  float length;
  std::uint32_t last, plane;
  float t;
  std::uint32_t surface, blocked;
};

struct Found {
  std::vector<TriedRay> by_tree, by_all;
};

}  // namespace renderer

// All columns have the same length, a multiple of every number of lanes.
namespace lane_math {

template <class T>
struct Fused {
  std::vector<T> a, b, c, add, sub, neg_add, neg_sub;
};

struct Elementary {
  std::vector<float> x, log, exp, minus_expm1, turns;
};

}  // namespace lane_math

// Traces for sdf_lanes_test.cpp, computed on each instruction set.
namespace sdf_lanes {

/// The rays o + t d, |d| = 1, t up to `far`.
struct Ray {
  carlo::Vec3 o, d;
  float far;
};

/// Rays in the order in which they get lanes, and where they met the sdf, in its units: below 0 if
/// nowhere.
struct Rays {
  std::vector<Ray> rays;
  std::vector<double> s;
  std::size_t gap = 0;  ///< after this many lanes one stays empty; 0: none does
};

}  // namespace sdf_lanes
