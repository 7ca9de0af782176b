#include "course/cli/main_guard.h"

#include "support/error.h"

#include <cstdio>
#include <exception>
#include <new>

namespace carlo {

int run_main(const std::function<int()>& body) {
  try {
    return body();
  } catch (const PlacedError& error) {
    fmt::print(stderr, "{}\n", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
  }
  return 1;
}

}  // namespace carlo
