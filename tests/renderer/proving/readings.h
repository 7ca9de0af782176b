#pragma once

#include "proving/ground.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace proving {

/// The scalar integrator, the vector kernel, and lab 08's solution in a loop.
constexpr std::array<const char*, 3> kernel_names = {"scalar", "vector", "lab 08"};

/// What one kernel's film says.
struct Reading {
  std::array<double, 3> mean{}, error{};  ///< of all pixels, and its standard error
  std::uint64_t bad = 0, cut = 0;         ///< as in Counts
  double seconds = 0;
};
/// One for each of kernel_names; none where the kernel does not take the scene.
using Readings = std::array<std::optional<Reading>, kernel_names.size()>;

/// Renders with all kernels on one thread. The numbers that kernels draw are independent: seeds
/// come from `seed` and the kernel. Lab 08 is left out if it is not asked for.
enum class Lab { asked, not_asked };
Readings read_film(const carlo::Scene& scene, std::uint32_t spp, std::uint64_t seed,
                   Lab lab = Lab::asked);

/// What is wrong with one scene, a line for each finding: "kernel got +- se, exact".
struct Finding {
  std::string name, line;
  const carlo::Scene* scene;
};

/// Deviations of more than 5 standard errors and what rounding may do; standard errors of more than
/// 2 %, with which too little would be seen; samples that are no radiances.
void judge_exact(const Proof& proof, const Readings& readings, std::vector<Finding>& findings);

/// Kernels that differ by more than 5 standard errors and this much, relative.
void judge_agreement(const std::string& name, const carlo::Scene& scene, double rounding,
                     const Readings& readings, std::vector<Finding>& findings);

}  // namespace proving
