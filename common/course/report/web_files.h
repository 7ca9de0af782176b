#pragma once

#include <string_view>

// The files of common/course/report/web/ as they were at build time.
namespace carlo::web {

std::string_view page_html();
std::string_view page_css();
std::string_view slider_js();
std::string_view turntable_css();
std::string_view turntable_js();
std::string_view viewer_html();
std::string_view viewer_css();
std::string_view viewer_pixels_js();
std::string_view viewer_js();

}  // namespace carlo::web
