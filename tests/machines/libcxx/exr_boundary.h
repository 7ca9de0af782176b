#pragma once

#include <cstddef>
#include <cstdint>

// Debian's OpenImageIO speaks the standard library of GCC. Where Carlo is built with LLVM's,
// exr.cpp stays with the former, in a shared library of its own, and C's types alone cross.

extern "C" {

struct CarloExrView {
  int width, height;
  int first_line, end_line;     ///< those in the file
  const float* pixels;          ///< RGB, row-major
  const float* standard_error;  ///< as pixels, or null
  std::size_t attributes;
  const char* const* attribute_names;
  const char* const* attribute_values;
  std::size_t counts;
  const char* const* count_names;
  const std::uint32_t* const* count_values;  ///< of each name, all pixels'
  std::size_t notes;
  const char* const* note_texts;
};

using CarloExrTake = void (*)(void* context, const CarloExrView* file);

/// These give null, or what is wrong; the text is the caller's to free().
char* carlo_exr_write(const char* path, const CarloExrView* file);
/// `take` is called once when the file could be read; what it is given lives until it returns.
char* carlo_exr_read(const char* path, const char* const* counts, std::size_t wanted,
                     CarloExrTake take, void* context);
}
