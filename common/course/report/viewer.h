#pragma once

#include "course/report/page.h"
#include "image/image.h"

#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// One image that a viewer shows, of linear radiances.
struct ViewerImage {
  std::string name;
  Image image;
  std::optional<Image> standard_error = std::nullopt;
};

/// Images of one size to look at on a page: two of them under a split slider, with exposure, zoom
/// and the numbers of each pixel. Where there is a reference, an image can also be shown as its
/// difference from it, as relMSE and as FLIP; where there is a standard error, as noise.
struct Viewer {
  std::string caption, note;
  std::vector<ViewerImage> images;  ///< the first one is shown first
  std::optional<ViewerImage> reference = std::nullopt;
};

/// Puts the viewer where the page's next words would stand. Throws Error when the images differ in
/// size or there is none.
void add_viewer(Page& page, const Viewer& viewer);

}  // namespace carlo
