#pragma once

#include <string_view>

// The files of common/report/web/ and Chart.js, as they were when the program was built.
namespace carlo::web {

std::string_view page_html();
std::string_view page_css();
std::string_view charts_js();
std::string_view viewer_html();
std::string_view viewer_css();
std::string_view viewer_pixels_js();
std::string_view viewer_js();
/// Chart.js 3.9 (MIT licence).
std::string_view chart_library_js();

}  // namespace carlo::web
