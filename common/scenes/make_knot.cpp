// carlo_knot_file FILE: writes the mesh of knot.xml.

#include "scenes/knot.h"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: carlo_knot_file FILE\n", stderr), 2;
  try {
    carlo::write_knot(argv[1], 100'000);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
