#pragma once

#include <cstddef>
#include <cstdint>

// Debian's OpenImageIO uses GCC's standard library. If Carlo is built with LLVM's, exr.cpp keeps
// the former, in its own shared library, and only C types cross the boundary.

extern "C" {

struct CarloExrView {
  int width, height;
  const float* pixels;          ///< RGB, row-major
  const float* standard_error;  ///< like pixels, or null
  const float* samples;         ///< one for each pixel, or null; never read back
  std::size_t attributes;
  const char* const* attribute_names;
  const char* const* attribute_values;
  std::size_t counts;
  const char* const* count_names;
  const std::uint32_t* const* count_values;  ///< per name, for all pixels
  std::size_t notes;
  const char* const* note_texts;
};

using CarloExrTake = void (*)(void* context, const CarloExrView* file);

/// These return null, or an error message for the caller to free().
char* carlo_exr_write(const char* path, const CarloExrView* file);
/// Calls `take` once if the file could be read; its arguments are valid until it returns.
char* carlo_exr_read(const char* path, const char* const* counts, std::size_t wanted,
                     CarloExrTake take, void* context);
}
