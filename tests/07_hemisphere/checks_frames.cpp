// Checks of exercise 7.1: exact properties, within the rounding of floats.

#include "07_hemisphere/law.h"

#include <cmath>

using namespace carlo::grader;
using namespace lab07_tests;

namespace {

const Diagnosis breaks_at_minus_z{
    "frame-breaks-at-minus-z",
    "the axes are no longer at right angles or of length 1 near n = -z: "
    "1 + n.z is nearly 0 there, and digits are lost."};
const Diagnosis breaks_near_axis{"frame-breaks-near-an-axis",
                                 "for a few normals the axes fail: the cross product of two "
                                 "nearly parallel vectors loses its length."};
const Diagnosis not_normalised{"axes-not-normalised",
                               "a cross product of vectors that are not at right angles is shorter "
                               "than 1: normalise it."};
const Diagnosis left_handed{"left-handed-frame",
                            "s x t is -n: exchange the factors of the cross product."};
const Diagnosis transposed{
    "to-world-and-to-local-exchanged",
    "one direction is a sum along the axes, the other dot products with them: they are exchanged."};

constexpr double tolerance = 1e-6;

struct FrameRow {
  Double3 s, t, n, world, local;
};

FrameRow frame_row(const Rows& rows, std::size_t i) {
  const auto vector = [&](std::size_t c) {
    return Double3(rows.at(i, c), rows.at(i, c + 1), rows.at(i, c + 2));
  };
  return {vector(0), vector(3), vector(6), vector(9), vector(12)};
}

/// The deviation of lengths and angles; the given normal has the best length that floats allow.
double error_of(const FrameRow& f) {
  const double lengths = std::max(std::abs(glm::length(f.s) - 1), std::abs(glm::length(f.t) - 1));
  const double angles = std::max(
      {std::abs(glm::dot(f.s, f.t)), std::abs(glm::dot(f.s, f.n)), std::abs(glm::dot(f.t, f.n))});
  const double worst = std::max(lengths, angles);
  return std::isfinite(lengths + angles) ? worst : HUGE_VAL;
}

std::vector<FrameRow> frames() {
  const std::size_t count = hard_normals().size();
  const Rows rows = probe("Lab 7.1 frames", {}, {.rows = count, .columns = 15, .finite = false});
  std::vector<FrameRow> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(frame_row(rows, i));
  return result;
}

std::string text_of(Double3 v) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z);
}

double distance(Double3 a, Double3 b) {
  const double d = glm::length(a - b);
  return std::isfinite(d) ? d : HUGE_VAL;
}

Double3 along(const FrameRow& f, Double3 v) {
  return v.x * f.s + v.y * f.t + v.z * f.n;
}
Double3 across(const FrameRow& f, Double3 v) {
  return {glm::dot(v, f.s), glm::dot(v, f.t), glm::dot(v, f.n)};
}

/// Judges the largest error that a search finds. The search finds a cross product with a fixed
/// helper for each of 320 random helpers; some helpers made of whole numbers up to 4 are exact
/// except for the normal along them, which is among the hard ones. Methods that lose digits through
/// 1 + n.z are worst close to -z; a helper may lie anywhere.
void judge_search() {
  const Rows rows = probe("Lab 7.1 search", {.n = 3000}, {.columns = 9, .finite = false});
  const auto vector = [&](std::size_t c) {
    return Double3(rows.at(0, c), rows.at(0, c + 1), rows.at(0, c + 2));
  };
  const FrameRow f{vector(3), vector(6), vector(0), {}, {}};
  const double error = error_of(f);
  judge(holds(fmt::format("lengths and right angles, worst at n = {}", text_of(f.n)),
              error <= tolerance, fmt::format("off by {:.2g}", error), "1 and 0 within 1e-6",
              {f.n.z < -0.999 ? breaks_at_minus_z : breaks_near_axis}));
}

}  // namespace

TEST_CASE("Lab 7.1: the axes are orthonormal for every normal, at and near n = -z too",
          "[lab07][ex1]") {
  const std::vector<Vec3> normals = hard_normals();
  const std::vector<FrameRow> all = frames();
  std::size_t wrong = 0, wrong_elsewhere = 0, worst = 0;
  double moved = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    moved = std::max(moved, distance(all[i].n, normals[i]));
    if (error_of(all[i]) > error_of(all[worst])) worst = i;
    if (error_of(all[i]) <= tolerance) continue;
    ++wrong;
    if (normals[i].z > -0.9f) ++wrong_elsewhere;
  }
  judge(holds("axis n", moved <= 1e-6,
              fmt::format("differs from the normal by up to {:.2g}", moved), "the given normal"));
  std::vector<Diagnosis> diagnoses;
  if (wrong_elsewhere == 0) {
    diagnoses = {breaks_at_minus_z};
  } else if (2 * wrong < all.size()) {
    diagnoses = {breaks_near_axis};
  } else {
    diagnoses = {not_normalised};
  }
  judge(holds(
      fmt::format("lengths and right angles, worst at n = {}", text_of(normals[worst])), wrong == 0,
      fmt::format("off by {:.2g}; {} of {} normals fail", error_of(all[worst]), wrong, all.size()),
      "1 and 0 within 1e-6 at all", diagnoses));
  if (wrong == 0) judge_search();
}

TEST_CASE("Lab 7.1: s, t, n are right-handed", "[lab07][ex1]") {
  const std::vector<Vec3> normals = hard_normals();
  const std::vector<FrameRow> all = frames();
  std::size_t left = 0, wrong = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Double3 n = glm::cross(all[i].s, all[i].t);
    if (distance(n, all[i].n) <= 2e-6) continue;
    ++wrong;
    if (distance(-n, all[i].n) <= 2e-6) ++left;
  }
  std::vector<Diagnosis> diagnoses;
  if (left > 0) diagnoses.push_back(left_handed);
  judge(holds("s x t", wrong == 0, fmt::format("is not n for {} of {} normals", wrong, all.size()),
              "n at all", diagnoses));
}

TEST_CASE("Lab 7.1: to_world goes along the axes and to_local comes back", "[lab07][ex1]") {
  double worst_world = 0, worst_local = 0, worst_transposed = 0;
  for (const FrameRow& f : frames()) {
    // Compared with the student's own axes: whether those are right is tested above.
    worst_world = std::max(worst_world, distance(f.world, along(f, frame_local)));
    worst_local = std::max(worst_local, distance(f.local, across(f, frame_world)));
    worst_transposed =
        std::max(worst_transposed, std::min(distance(f.world, across(f, frame_local)),
                                            distance(f.local, along(f, frame_world))));
  }
  std::vector<Diagnosis> diagnoses;
  if (worst_transposed <= tolerance) diagnoses.push_back(transposed);
  judge(holds("to_world", worst_world <= tolerance, fmt::format("off by up to {:.2g}", worst_world),
              "the sum of the axes times the coordinates, within 1e-6", diagnoses));
  judge(holds("to_local", worst_local <= tolerance, fmt::format("off by up to {:.2g}", worst_local),
              "the dot products with the axes, within 1e-6", diagnoses));
}
