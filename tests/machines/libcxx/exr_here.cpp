#include "exr_boundary.h"
#include "image/exr.h"
#include "support/error.h"

#include <dlfcn.h>

#include <cstdlib>
#include <memory>

// This side of the boundary: read_exr() and write_exr() for whoever links them.

namespace carlo {
namespace {

/// Loads a function of the library. Both standard libraries share the code that throws and catches:
/// the one that the program links first.
template <class Function>
Function* there(const char* name) {
  void* const library = ::dlopen(CARLO_EXR_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  void* const function = library == nullptr ? nullptr : ::dlsym(library, name);
  if (function == nullptr) throw Error("no OpenEXR: {}", ::dlerror());
  return reinterpret_cast<Function*>(function);
}

void require_none(char* error) {
  const std::unique_ptr<char, decltype(&std::free)> owned(error, &std::free);
  if (error != nullptr) throw Error("{}", error);
}

Image image_of(const CarloExrView& view, const float* values) {
  Image image(view.width, view.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = Rgb(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return image;
}

std::vector<float> values_of(const Image& image) {
  std::vector<float> values;
  for (const Rgb& pixel : image.pixels)
    values.insert(values.end(), {pixel.r, pixel.g, pixel.b});
  return values;
}

void take(void* context, const CarloExrView* view) {
  ExrFile& file = *static_cast<ExrFile*>(context);
  file.image = image_of(*view, view->pixels);
  if (view->standard_error != nullptr) file.standard_error = image_of(*view, view->standard_error);
  for (std::size_t i = 0; i < view->attributes; ++i)
    file.attributes[view->attribute_names[i]] = view->attribute_values[i];
  for (std::size_t i = 0; i < view->counts; ++i) {
    const std::uint32_t* const values = view->count_values[i];
    file.counts[view->count_names[i]].assign(values, values + file.image.pixels.size());
  }
  file.notes.assign(view->note_texts, view->note_texts + view->notes);
}

}  // namespace

void write_exr(const std::filesystem::path& path, const ExrFile& file) {
  const std::vector<float> pixels = values_of(file.image);
  const std::vector<float> errors =
      file.standard_error ? values_of(*file.standard_error) : std::vector<float>{};
  std::vector<const char*> names, texts, count_names;
  std::vector<const std::uint32_t*> count_values;
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
                          file.samples.empty() ? nullptr : file.samples.data(),
                          names.size(),
                          names.data(),
                          texts.data(),
                          count_names.size(),
                          count_names.data(),
                          count_values.data(),
                          0,
                          nullptr};
  require_none(there<decltype(carlo_exr_write)>("carlo_exr_write")(path.c_str(), &view));
}

ExrFile read_exr(const std::filesystem::path& path, const std::vector<std::string>& counts) {
  std::vector<const char*> names;
  for (const std::string& name : counts)
    names.push_back(name.c_str());
  ExrFile file;
  require_none(there<decltype(carlo_exr_read)>("carlo_exr_read")(path.c_str(), names.data(),
                                                                 names.size(), &take, &file));
  return file;
}

}  // namespace carlo
