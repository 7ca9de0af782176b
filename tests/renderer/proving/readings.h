#pragma once

#include "proving/ground.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace proving {

/// The scalar integrator, the vector kernel, the same with pixels that share, and lab 8's solution
/// in a loop.
constexpr std::array<const char*, 4> kernel_names = {"scalar", "vector", "shared", "lab 08"};

/// The result of one kernel's film.
struct Reading {
  std::array<double, 3> mean{}, error{};  ///< over all pixels, and its standard error
  std::uint64_t bad = 0, cut = 0;         ///< as in Counts
  double seconds = 0;
};
/// One for each of kernel_names; empty if the kernel does not support the scene.
using Readings = std::array<std::optional<Reading>, kernel_names.size()>;

/// Renders with all kernels on one thread. The kernels' random numbers are independent: seeds come
/// from `seed` and the kernel. Lab 8 is only included on request.
enum class Lab { asked, not_asked };
Readings read_film(const carlo::Scene& scene, std::uint32_t spp, std::uint64_t seed,
                   Lab lab = Lab::asked);

/// An error of a scene, one line each: "kernel got +- se, exact".
struct Finding {
  std::string name, line;
  const carlo::Scene* scene;
};

/// Finds deviations beyond 5 standard errors and rounding; standard errors above 2 %, which would
/// detect too little; and samples that are no radiances.
void judge_exact(const Proof& proof, const Readings& readings, std::vector<Finding>& findings);

/// Finds kernels that differ by more than 5 standard errors and this relative amount.
void judge_agreement(const std::string& name, const carlo::Scene& scene, double rounding,
                     const Readings& readings, std::vector<Finding>& findings);

}  // namespace proving
