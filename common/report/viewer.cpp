#include "report/viewer.h"

#include "cli/error.h"
#include "image/flip.h"
#include "report/packed.h"
#include "report/web_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace carlo {
namespace {

using nlohmann::json;

void require_size(const ViewerImage& image, const Image& first) {
  const auto check = [&](const Image& i) {
    if (i.width == first.width && i.height == first.height && !i.pixels.empty()) return;
    throw Error("a viewer's images must be of one size: '{}' has {} x {}, not {} x {}", image.name,
                i.width, i.height, first.width, first.height);
  };
  check(image.image);
  if (image.standard_error) check(*image.standard_error);
}

json image_json(const ViewerImage& image, const std::optional<ViewerImage>& reference) {
  json result = {{"name", image.name}, {"rgb", packed(image.image)}};
  if (image.standard_error) result["error"] = packed(*image.standard_error);
  if (reference) result["flip"] = packed(flip_map(image.image, reference->image));
  return result;
}

json viewer_json(const Viewer& viewer) {
  auto images = json::array();
  for (const ViewerImage& image : viewer.images)
    images.push_back(image_json(image, viewer.reference));
  if (viewer.reference) images.push_back(image_json(*viewer.reference, std::nullopt));
  const Image& first = viewer.images.front().image;
  return {{"width", first.width},
          {"height", first.height},
          {"images", images},
          {"reference", viewer.reference ? static_cast<int>(viewer.images.size()) : -1}};
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
      json_for_html(viewer_json(viewer))));
}

}  // namespace carlo
