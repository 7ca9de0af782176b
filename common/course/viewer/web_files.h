#pragma once

#include <string_view>

// The files of common/course/viewer/web/ as they were at build time.
namespace carlo::web {

std::string_view turntable_css();
std::string_view turntable_js();
std::string_view viewer_html();
std::string_view viewer_css();
std::string_view viewer_pixels_js();
std::string_view viewer_js();

}  // namespace carlo::web
