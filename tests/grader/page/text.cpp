#include "grader/page/text.h"

#include "course/report/page.h"

namespace carlo::grader {

std::string printable(std::string_view text) {
  std::string safe(text);
  for (char& c : safe) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 32 && c != '\n' && c != '\t') || byte == 127) c = ' ';
  }
  return safe;
}

std::string html(std::string_view text) {
  return html_escaped(printable(text));
}

}  // namespace carlo::grader
