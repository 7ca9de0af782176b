#pragma once

#include "renderer/lanes/lane_kernel.h"

#include <catch2/catch_test_macros.hpp>

#include <string>

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
