#include "renderer/production/definitions.h"

#include "course/json/json_fields.h"

#include <fmt/core.h>

namespace carlo {

namespace {

struct Definitions {
  std::vector<std::string> list;
};

void fields(JsonFields& json, Definitions& definitions) {
  json("definitions", definitions.list);
}

}  // namespace

std::string definitions_text(const std::vector<std::string>& definitions) {
  return json_text(Definitions{definitions});
}

std::vector<std::string> definitions_of(const std::string& text, const std::string& place) {
  // Older renders have the list alone.
  const bool bare = text.starts_with('[');
  return from_json_text<Definitions>(bare ? fmt::format("{{\"definitions\": {}}}", text) : text,
                                     place)
      .list;
}

}  // namespace carlo
