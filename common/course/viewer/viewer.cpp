#include "course/viewer/viewer.h"

#include "course/json/json_fields.h"
#include "course/viewer/packed.h"
#include "course/viewer/web_files.h"
#include "image/flip.h"
#include "support/error.h"

#include <fmt/format.h>

namespace carlo {
namespace {

void require_size(const ViewerImage& image, const Image& first) {
  const auto check = [&](const Image& i) {
    if (i.width == first.width && i.height == first.height && !i.pixels.empty()) return;
    throw Error("a viewer's images must be of one size: '{}' has {} x {}, not {} x {}", image.name,
                i.width, i.height, first.width, first.height);
  };
  check(image.image);
  if (image.standard_error) check(*image.standard_error);
}

/// An image as the page's script reads it.
struct PackedImage {
  std::string name, rgb;
  std::optional<std::string> error = std::nullopt, flip = std::nullopt;
};

void fields(JsonFields& json, PackedImage& image) {
  json("name", image.name);
  json("rgb", image.rgb);
  json("error", image.error);
  json("flip", image.flip);
}

struct PackedViewer {
  int width = 0, height = 0;
  std::vector<PackedImage> images = {};
  int reference = -1;  ///< index of the reference among the images
};

void fields(JsonFields& json, PackedViewer& viewer) {
  json("width", viewer.width);
  json("height", viewer.height);
  json("images", viewer.images);
  json("reference", viewer.reference);
}

PackedImage pack(const ViewerImage& image, const std::optional<ViewerImage>& reference) {
  PackedImage result{image.name, packed(image.image)};
  if (image.standard_error) result.error = packed(*image.standard_error);
  if (reference) result.flip = packed(flip_map(image.image, reference->image));
  return result;
}

PackedViewer pack(const Viewer& viewer) {
  const Image& first = viewer.images.front().image;
  PackedViewer result{first.width, first.height};
  for (const ViewerImage& image : viewer.images)
    result.images.push_back(pack(image, viewer.reference));
  if (viewer.reference) {
    result.reference = static_cast<int>(viewer.images.size());
    result.images.push_back(pack(*viewer.reference, std::nullopt));
  }
  return result;
}

}  // namespace

void add_viewer(Page& page, const Viewer& viewer) {
  if (viewer.images.empty()) throw Error("a viewer needs an image");
  const Image& first = viewer.images.front().image;
  for (const ViewerImage& image : viewer.images)
    require_size(image, first);
  if (viewer.reference) require_size(*viewer.reference, first);
  if (page.once("viewer")) {
    page.style(web::viewer_css());
    page.script(web::viewer_pixels_js());
    page.script(web::viewer_js());
    page.raw_html(
        fmt::format("<template id=\"viewer-template\">{}</template>\n", web::viewer_html()));
  }
  page.raw_html(fmt::format(
      "<figure class=\"viewer\"><figcaption>{}{}</figcaption>\n"
      "<div class=\"viewer-body\"><noscript>The images need JavaScript.</noscript></div>\n"
      "<script type=\"application/json\">{}</script></figure>\n",
      html_escaped(viewer.caption),
      viewer.note.empty() ? "" : fmt::format("<span>{}</span>", html_escaped(viewer.note)),
      json_for_html(json_text(pack(viewer)))));
}

}  // namespace carlo
