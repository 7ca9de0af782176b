#pragma once

#include <string_view>

// The files of common/course/report/web/ as they were at build time.
namespace carlo::web {

std::string_view page_html();
std::string_view page_css();
std::string_view slider_js();

}  // namespace carlo::web
