#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Returns a slider over `content` (trusted HTML), for Page::raw_html(): `words` has the text for
/// each of its positions; it begins at `start`.
std::string slider_html(std::string_view label, const std::vector<std::string>& words,
                        std::size_t start, std::string_view content);

/// Returns the part of the content's drawings that is shown only at the positions from `first` to
/// `last`.
std::string shown_at(std::size_t first, std::size_t last, std::string_view svg);

/// Returns the script that moves all sliders of a page, for Page::script(), once.
std::string_view slider_script();

}  // namespace carlo
