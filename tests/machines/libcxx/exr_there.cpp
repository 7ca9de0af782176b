#include "exr_boundary.h"
#include "image/exr.h"

#include <cstring>
#include <exception>

// The far side of the boundary: with OpenImageIO's standard library.

namespace {

using carlo::ExrFile;
using carlo::Image;

Image image_of(const CarloExrView& view, const float* values) {
  Image image(view.width, view.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = carlo::Rgb(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return image;
}

std::vector<float> values_of(const Image& image) {
  std::vector<float> values;
  for (const carlo::Rgb& pixel : image.pixels)
    values.insert(values.end(), {pixel.r, pixel.g, pixel.b});
  return values;
}

template <class Work>
char* error_of(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return ::strdup(error.what());
  }
  return nullptr;
}

}  // namespace

[[gnu::visibility("default")]] char* carlo_exr_write(const char* path, const CarloExrView* view) {
  return error_of([&] {
    ExrFile file{image_of(*view, view->pixels)};
    if (view->standard_error != nullptr)
      file.standard_error = image_of(*view, view->standard_error);
    if (view->samples != nullptr)
      file.samples.assign(view->samples, view->samples + file.image.pixels.size());
    for (std::size_t i = 0; i < view->attributes; ++i)
      file.attributes[view->attribute_names[i]] = view->attribute_values[i];
    for (std::size_t i = 0; i < view->counts; ++i) {
      const std::uint32_t* const values = view->count_values[i];
      file.counts[view->count_names[i]].assign(values, values + file.image.pixels.size());
    }
    carlo::write_exr(path, file);
  });
}

[[gnu::visibility("default")]] char* carlo_exr_read(const char* path, const char* const* counts,
                                                    std::size_t wanted, CarloExrTake take,
                                                    void* context) {
  return error_of([&] {
    const ExrFile file = carlo::read_exr(path, {counts, counts + wanted});
    const std::vector<float> pixels = values_of(file.image);
    const std::vector<float> errors =
        file.standard_error ? values_of(*file.standard_error) : std::vector<float>{};
    std::vector<const char*> names, texts, count_names, notes;
    std::vector<const std::uint32_t*> count_values;
    for (const std::string& note : file.notes)
      notes.push_back(note.c_str());
    for (const auto& [name, text] : file.attributes) {
      names.push_back(name.c_str());
      texts.push_back(text.c_str());
    }
    for (const auto& [name, values] : file.counts) {
      count_names.push_back(name.c_str());
      count_values.push_back(values.data());
    }
    const CarloExrView view{file.image.width,
                            file.image.height,
                            pixels.data(),
                            file.standard_error ? errors.data() : nullptr,
                            nullptr,
                            names.size(),
                            names.data(),
                            texts.data(),
                            count_names.size(),
                            count_names.data(),
                            count_values.data(),
                            notes.size(),
                            notes.data()};
    take(context, &view);
  });
}
