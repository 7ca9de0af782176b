#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace renderer {

/// What lights are chosen by in the vector kernel (choice-inl.h), and where paths from lamps start.
///
/// A light is asked in proportion to the irradiance that it would bring unoccluded, about that. To
/// estimate it for each of a hundred lights takes longer than the path's rays, so lights that stand
/// together are estimated together, in `groups`; within one they are chosen by their strength.
/// A sixteenth of the choices is for all lights alike that can bring anything.
struct LaneLights {
  static constexpr std::size_t most = 128;        ///< lights
  static constexpr std::size_t most_groups = 24;  ///< up to so many lights are groups of their own
  template <class T>
  using Column = std::array<T, most>;
  template <class T>
  using GroupColumn = std::array<T, most_groups>;

  /// What the scene's writer tells of a light.
  struct Light {
    glm::dvec3 middle{0};  ///< of a sphere around it,
    double reach = 0;      ///< and its radius
    double strength = 0;   ///< what is flat: radiance x area, other lights: intensity; R + G + B
    double power = 0;      ///< of a path's start; 0: none starts there
    struct Plane {
      glm::dvec3 normal;
      double d;
    };
    std::optional<Plane> plane = std::nullopt;  ///< of what is flat
    bool everywhere = false;                    ///< the image around, whose strength is irradiance
  };

  LaneLights() = default;
  explicit LaneLights(const std::vector<Light>& lights);

  std::uint32_t groups = 0;
  std::uint32_t first_round = 0;   ///< from here on groups have no plane in common
  std::uint32_t sky = 0xFFFFFFFF;  ///< the group of the image around, if there is one
  GroupColumn<float> middle_x{}, middle_y{}, middle_z{}, reach{}, strength{};
  GroupColumn<float> nx{}, ny{}, nz{}, d{};    ///< the plane
  GroupColumn<std::uint32_t> first{}, size{};  ///< of a group, in the list of its members
  std::uint32_t largest = 0;                   ///< size
  Column<std::uint32_t> member{};              ///< the list: lights
  Column<float> upto{};  ///< and of each the running sum of strengths in its group, 1 at the end

  // Of each light:
  Column<std::uint32_t> group{};
  Column<float> share{};  ///< of its group's strength
  /// The running sum of the chances with which paths from lamps start there: multiples of 2^-24,
  /// the step of the u's, so that they are what is drawn; and each chance.
  Column<float> start_upto{}, start_chance{};

 private:
  void add_group(const std::vector<Light>& lights, const std::vector<std::uint32_t>& members,
                 double brightest);
  void share_out_starts(const std::vector<Light>& lights);
};

}  // namespace renderer
