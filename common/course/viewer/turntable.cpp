#include "course/viewer/turntable.h"

#include "course/report/html.h"
#include "course/viewer/web_files.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace carlo {
namespace {

std::string data(const Turntable& picture) {
  auto list = nlohmann::json::array();
  for (const Cloud& cloud : picture.clouds) {
    auto points = nlohmann::json::array();
    for (const auto& point : cloud.points) {
      for (const double x : point)
        points.push_back(static_cast<int>(std::floor(x * 4096)));
    }
    list.push_back({{"name", cloud.name},
                    {"note", cloud.note + " Drag, or use the arrow keys, to turn it."},
                    {"points", points},
                    {"normal", cloud.normal},
                    {"lines", cloud.lines}});
  }
  const nlohmann::json picture_json = {{"clouds", list}, {"wires", picture.wires}};
  return json_for_html(picture_json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

std::string turntable_html(const Turntable& picture) {
  std::string html = fmt::format(
      "<style>{}</style><figure class=\"turntable\"><figcaption>{}</figcaption><div "
      "class=\"choice\">",
      web::turntable_css(), html_escaped(picture.caption));
  for (const Cloud& cloud : picture.clouds) {
    html += fmt::format("<button type=\"button\" data-cloud aria-pressed=\"false\">{}</button>",
                        html_escaped(cloud.name));
  }
  return html +
         fmt::format(
             "</div><canvas id=\"turntable\" tabindex=\"0\" role=\"img\" aria-label=\"{} Arrow "
             "keys turn "
             "it.\"></canvas><div class=\"choice\"><button type=\"button\" "
             "id=\"turntable-along\">{}</button><button type=\"button\" id=\"turntable-back\">Turn "
             "back</button></div><p id=\"turntable-note\" aria-live=\"polite\"></p></figure>"
             "<script type=\"application/json\" id=\"turntable-data\">{}</script>\n",
             html_escaped(picture.label), html_escaped(picture.along), data(picture));
}

std::string_view turntable_script() {
  return web::turntable_js();
}

}  // namespace carlo
