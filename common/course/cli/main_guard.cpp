#include "course/cli/main_guard.h"

#include "support/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace carlo {
namespace {

/// Not fmt::print(), which throws if stderr is closed or its disk is full.
void print_error(const std::string& line) {
  std::fputs((line + "\n").c_str(), stderr);
}

}  // namespace

int run_main(const std::function<int()>& body) {
  try {
    return body();
  } catch (const PlacedError& error) {
    print_error(error.what());
  } catch (const std::bad_alloc&) {
    std::fputs("error: out of memory\n", stderr);
  } catch (const std::exception& error) {
    print_error(fmt::format("error: {}", error.what()));
  }
  return 1;
}

}  // namespace carlo
