#pragma once

#include "renderer/lanes/lane_kernel.h"

#include <catch2/catch_test_macros.hpp>

#include <string>

namespace instruction_sets {

/// With each of the kernel's that this machine has in use.
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
