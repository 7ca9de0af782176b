#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace lab02 {

/// HTML and script of the dart board with its slider, and of the estimate's way beside it.
/// `data`: "points" is a list of darts [x, y], in the order thrown; "steps" a list of
/// [N, hits, estimate, lower, upper] with N growing, lower and upper null where there are none.
std::string board_html();
std::string board_script(const nlohmann::json& data);

}  // namespace lab02
