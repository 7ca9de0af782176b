#include "scene/ids.h"

#include "scene/text.h"

namespace carlo {

void Ids::declare(const XmlElement& element, SceneErrors& errors) {
  const XmlAttribute* id = element.find("id");
  if (id != nullptr && element.name != "ref" && !element.broken) {
    errors.guard([&] {
      if (id->value.empty()) fail(id->value_at, "an id must not be empty");
      if (!kinds_.emplace(id->value, element.name).second) {
        fail(id->value_at, "the id {} is given twice", in_quotes(id->value));
      }
    });
  }
  for (const XmlElement& child : element.children)
    declare(child, errors);
}

const std::string* Ids::kind(const std::string& id) const {
  const auto found = kinds_.find(id);
  return found == kinds_.end() ? nullptr : &found->second;
}

}  // namespace carlo
