#include "render/blocks.h"

#include "render/driver.h"

namespace carlo {

int BlockGrid::columns() const {
  return (width + driver_tile_size - 1) / driver_tile_size;
}

std::uint64_t BlockGrid::tiles() const {
  const int rows = (height + driver_tile_size - 1) / driver_tile_size;
  return static_cast<std::uint64_t>(columns()) * static_cast<std::uint64_t>(rows);
}

}  // namespace carlo
