#pragma once

#include <functional>

namespace carlo {

/// Runs `body` and turns exceptions into one line on stderr and exit code 1. Every main() of the
/// project is `return run_main([&] { ... });`.
int run_main(const std::function<int()>& body);

}  // namespace carlo
