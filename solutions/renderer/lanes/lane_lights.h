#pragma once

#include "renderer/lanes/lane_light_tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace renderer {

/// One property of many surfaces or lights, 0 at first. It is never so short that kernels, which
/// read whole registers, read past its end.
template <class T>
class Column {
 public:
  static constexpr std::size_t least = 128;

  explicit Column(std::size_t size = least) : entries_(std::max(size, least)) {}

  T& operator[](std::size_t i) { return entries_[i]; }
  const T& operator[](std::size_t i) const { return entries_[i]; }
  const T* data() const { return entries_.data(); }

 private:
  std::vector<T> entries_;
};

/// How the vector kernel chooses lights (choice-inl.h), and where light paths start.
///
/// A light is chosen in proportion to an estimate of its unoccluded irradiance. Estimating it for
/// each of a hundred lights takes longer than the path's rays, so lights that stand together are
/// estimated together, in `groups`; within a group they are chosen by their strength. One sixteenth
/// of the choices is shared equally by all lights that can contribute.
struct LaneLights {
  static constexpr std::size_t few = 128;         ///< more lights are chosen by a tree
  static constexpr std::size_t most_groups = 24;  ///< up to this number, every light is a group of
                                                  ///< its own
  template <class T>
  using GroupColumn = std::array<T, most_groups>;

  using Light = LaneLight;

  LaneLights() = default;
  explicit LaneLights(const std::vector<Light>& lights);

  LaneLightTree tree;  ///< its nodes, if there are more than a few lights; then there are no groups
  bool many() const { return !tree.nodes.empty(); }

  std::uint32_t groups = 0;
  std::uint32_t first_round = 0;   ///< groups from here on have no common plane
  std::uint32_t sky = 0xFFFFFFFF;  ///< the group of the environment map, if there is one
  GroupColumn<float> middle_x{}, middle_y{}, middle_z{}, reach{}, strength{};
  GroupColumn<float> nx{}, ny{}, nz{}, d{};    ///< the common plane
  GroupColumn<std::uint32_t> first{}, size{};  ///< of a group, in the list of its members
  std::uint32_t largest = 0;                   ///< of the group sizes
  Column<std::uint32_t> member{};              ///< the list: lights
  Column<float> upto{};  ///< running sum of strengths within the group, 1 at the end

  // For each of a few lights:
  Column<std::uint32_t> group{};
  Column<float> share{};  ///< fraction of its group's strength
  /// For each light: the running sum of the probabilities with which light paths start there, in
  /// multiples of 2^-24, the step of the u's, so that they are exact; and each probability.
  Column<float> start_upto{}, start_probability{};

 private:
  void add_group(const std::vector<Light>& lights, const std::vector<std::uint32_t>& members,
                 double brightest);
  void share_out_starts(const std::vector<Light>& lights);
};

}  // namespace renderer
