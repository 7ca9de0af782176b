#include "grader/page/text.h"

#include "report/format.h"
#include "report/page.h"

#include <nlohmann/json.hpp>

namespace carlo::grader {

using nlohmann::json;

namespace {

const json* member(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

}  // namespace

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

std::string text_in(const json& object, const char* key) {
  const json* value = member(object, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : "";
}

std::string number_in(const json& object, const char* key) {
  const json* value = member(object, key);
  return value != nullptr && value->is_number() ? number_text(value->get<double>(), 6) : "?";
}

const json& list_in(const json& object, const char* key) {
  static const json none = json::array();
  const json* value = member(object, key);
  return value != nullptr && value->is_array() ? *value : none;
}

bool true_in(const json& object, const char* key) {
  const json* value = member(object, key);
  return value != nullptr && value->is_boolean() && value->get<bool>();
}

}  // namespace carlo::grader
