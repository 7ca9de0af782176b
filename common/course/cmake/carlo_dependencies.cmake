# Finds every library we use, once, as an imported target. `./carlo setup` installs them; the
# message for a missing one names its Debian package.

set(carlo_hint "run './carlo setup', or install the Debian package")

macro(carlo_find package debian)
  find_package(${package} QUIET ${ARGN})
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "${package} was not found: ${carlo_hint} ${debian}")
  endif()
endmacro()

find_package(Threads REQUIRED)
carlo_find(glm libglm-dev)
carlo_find(fmt libfmt-dev)
carlo_find(nlohmann_json nlohmann-json3-dev)
carlo_find(pugixml libpugixml-dev)
carlo_find(TBB libtbb-dev)
carlo_find(hwy libhwy-dev)
carlo_find(Boost libboost-math-dev CONFIG)
carlo_find(ZLIB zlib1g-dev)
carlo_find(Catch2 "libcatch2-dev (from bookworm-backports)" 3)

# We do not report warnings in third-party headers.
set_target_properties(glm::glm PROPERTIES IMPORTED_NO_SYSTEM FALSE)

find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 QUIET)
endif()
if(NOT embree_FOUND)
  message(FATAL_ERROR "Embree 3 or 4 was not found: ${carlo_hint} libembree-dev")
endif()

# Debian's CMake files for OpenImageIO also require its command-line tools; we need only the
# library.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util)
if(NOT OPENIMAGEIO_INCLUDE_DIR OR NOT OPENIMAGEIO_LIBRARY OR NOT OPENIMAGEIO_UTIL_LIBRARY)
  message(FATAL_ERROR "OpenImageIO was not found: ${carlo_hint} libopenimageio-dev")
endif()
add_library(OpenImageIO::OpenImageIO INTERFACE IMPORTED)
target_include_directories(OpenImageIO::OpenImageIO SYSTEM INTERFACE "${OPENIMAGEIO_INCLUDE_DIR}")
target_link_libraries(OpenImageIO::OpenImageIO INTERFACE "${OPENIMAGEIO_LIBRARY}"
                      "${OPENIMAGEIO_UTIL_LIBRARY}")

find_path(STB_INCLUDE_DIR stb/stb_image_write.h)
if(NOT STB_INCLUDE_DIR)
  message(FATAL_ERROR "stb_image_write.h was not found: ${carlo_hint} libstb-dev")
endif()
