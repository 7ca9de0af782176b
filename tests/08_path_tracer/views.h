#pragma once

#include "08_path_tracer/scenes.h"
#include "grader/protocol/params.h"

#include <fmt/core.h>

#include <string>

// The views of the probes of lab 8's paths, as requested by the checks.

namespace lab08_tests {

/// "place" of a probe's parameters.
enum Place {
  in_furnace = 0,      ///< r, g, b: its albedo
  with_glass = 1,      ///< a furnace around a ball of glass
  on_ball = 2,         ///< kd, ks, exponent; degrees
  on_floor = 3,        ///< light: the Light over it
  mirror_ball = 4,     ///< r, g, b: its reflectance; degrees
  glass_ball = 5,      ///< degrees
  in_mirrors = 6,      ///< a furnace that mirrors; r, g, b: its reflectance
  behind_glass = 7,    ///< a wall that glows, seen through a ball of glass
  wall_in_mirror = 8,  ///< the same, seen in a ball of mirror; r, g, b: its reflectance
  by_mirror = 9,       ///< a floor lit only by way of a mirror
  by_pane = 10,        ///< the same, a pane of glass
};

/// A description of the place and of the point of view.
inline std::string place_text(const carlo::grader::Params& params) {
  const auto rgb = [&] {
    if (params["r"] == params["g"] && params["g"] == params["b"])
      return fmt::format("{:g}", params["r"]);
    return fmt::format("({:g}, {:g}, {:g})", params["r"], params["g"], params["b"]);
  };
  const double degrees = params["degrees"];
  switch (static_cast<Place>(params.whole("place"))) {
    case in_furnace:
      return "a furnace of albedo " + rgb();
    case with_glass:
      return fmt::format("a furnace of albedo {} around a glass ball", rgb());
    case on_ball:
      return fmt::format("a ball of kd = {:g}, ks = {:g}, n = {:g} at {:g} degrees", params["kd"],
                         params["ks"], params["exponent"], degrees);
    case on_floor:
      return fmt::format("a floor under {}", name_of(static_cast<Light>(params.whole("light"))));
    case mirror_ball:
      return fmt::format("a mirror ball of {} at {:g} degrees", rgb(), degrees);
    case glass_ball:
      return fmt::format("a glass ball at {:g} degrees", degrees);
    case in_mirrors:
      return "a furnace of mirrors of " + rgb();
    case wall_in_mirror:
      return "a glowing wall in a mirror of " + rgb();
    case by_mirror:
      return "a floor that sees a light in a mirror only";
    case by_pane:
      return "a floor that sees a light through a pane of glass only";
    case behind_glass:
      break;
  }
  return "a glowing wall through a glass ball";
}

/// The same, and what is left out.
inline std::string view_text(const carlo::grader::Params& params) {
  return place_text(params) + (params["emission"] == 0 ? ", without its emission" : "");
}

}  // namespace lab08_tests
