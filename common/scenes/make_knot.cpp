// carlo_knot FILE TRIANGLES: writes the mesh of knot.xml.

#include "scenes/knot.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: carlo_knot FILE TRIANGLES\n", stderr), 2;
  try {
    carlo::write_knot(argv[1], std::atoi(argv[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
