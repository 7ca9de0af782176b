#include "cli/main_guard.h"

#include "cli/error.h"

#include <cstdio>
#include <exception>
#include <new>
#include <string_view>

namespace carlo {

int run_main(const std::function<int()>& body) {
  try {
    return body();
  } catch (const Error& error) {
    // Errors in files come as FILE:LINE:COLUMN: error: ..., the others get their word here.
    const std::string_view text = error.what();
    const bool said = text.find("error: ") != std::string_view::npos;
    fmt::print(stderr, "{}{}\n", said ? "" : "error: ", text);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
  }
  return 1;
}

}  // namespace carlo
