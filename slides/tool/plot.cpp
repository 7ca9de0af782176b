// Draws one plot of a slide: JSON from plot.mjs on stdin, SVG on stdout.

#include "course/cli/main_guard.h"
#include "tool/figure.h"

#include <fmt/core.h>

#include <iostream>
#include <iterator>
#include <string>

int main() {
  return carlo::run_main([] {
    const std::string text(std::istreambuf_iterator<char>(std::cin), {});
    fmt::print("{}", carlo::figure_svg(text));
    return 0;
  });
}
