#pragma once

#include "course/report/page.h"
#include "image/image.h"

#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// One image of linear radiances in a viewer.
struct ViewerImage {
  std::string name;
  Image image;
  std::optional<Image> standard_error = std::nullopt;
};

/// Images of one size to inspect on a page: two of them under a split slider, with exposure, zoom
/// and the numbers of each pixel. With a reference, an image can also be shown as its difference
/// from it, as relMSE and as FLIP; with a standard error, as noise.
struct Viewer {
  std::string caption, note;
  std::vector<ViewerImage> images;  ///< the first is shown first
  std::optional<ViewerImage> reference = std::nullopt;
};

/// Adds the viewer at the page's current end. Throws Error if the images differ in size or there is
/// none.
void add_viewer(Page& page, const Viewer& viewer);

}  // namespace carlo
