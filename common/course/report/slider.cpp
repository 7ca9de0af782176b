#include "course/report/slider.h"

#include "course/report/html.h"
#include "course/report/web_files.h"

#include <fmt/core.h>

namespace carlo {

std::string slider_html(std::string_view label, const std::vector<std::string>& words,
                        std::size_t start, std::string_view content) {
  std::string html = fmt::format(
      "<div class=\"slider\"><label>{} <input type=\"range\" min=\"0\" max=\"{}\" "
      "value=\"{}\"></label>",
      html_escaped(label), words.size() - 1, start);
  for (std::size_t i = 0; i < words.size(); ++i) {
    html += fmt::format("<output data-first=\"{0}\" data-last=\"{0}\"{1}>{2}</output>", i,
                        i == start ? "" : " style=\"display: none\"", html_typeset(words[i]));
  }
  return fmt::format("{}\n{}</div>\n", html, content);
}

std::string shown_at(std::size_t first, std::size_t last, std::string_view svg) {
  return fmt::format("<g data-first=\"{}\" data-last=\"{}\">{}</g>\n", first, last, svg);
}

std::string_view slider_script() {
  return web::slider_js();
}

}  // namespace carlo
