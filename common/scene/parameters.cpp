#include "scene/parameters.h"

#include "scene/text.h"

namespace carlo {
namespace {

constexpr std::string_view name_characters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";

/// The names as they appear in a scene.
std::vector<std::string> with_dollar(std::vector<std::string> names) {
  for (std::string& name : names)
    name.insert(0, 1, '$');
  return names;
}

}  // namespace

void Parameters::declare(const XmlElement& element, SceneErrors& errors) {
  element.allow_only({"name", "value"}, errors);
  element.allow_nothing_inside(errors);
  const auto check = [&] {
    const XmlAttribute& name = element.get("name");
    element.get("value");
    if (name.value.empty() || name.value.find_first_not_of(name_characters) != std::string::npos) {
      fail(name.value_at, "a parameter's name has letters, digits and _ only, got {}",
           in_quotes(name.value));
    }
  };
  if (!errors.guard(check) || element.broken) return errors.lose_names();
  const XmlAttribute& name = element.get("name");
  if (!declared_.emplace(element.at.source, name.value).second) {
    fail(name.value_at, "the default {} is given twice in this file", in_quotes(name.value));
  }
  const auto chosen = overrides_.find(name.value);
  values_.emplace(name.value,
                  chosen != overrides_.end() ? chosen->second : element.get("value").value);
}

void Parameters::substitute(XmlElement& element, SceneErrors& errors) const {
  for (XmlAttribute& attribute : element.attributes) {
    SceneErrors found;
    if (found.guard([&] { attribute.value = replaced(attribute); })) continue;
    element.broken = attribute.broken = true;
    if (!errors.names_lost()) errors.guard([&] { found.raise(); });
  }
  for (XmlElement& child : element.children)
    substitute(child, errors);
}

void Parameters::check_overrides(Position at, SceneErrors& errors) const {
  for (const auto& [name, value] : overrides_) {
    if (values_.count(name) != 0) continue;
    errors.guard([&, &name = name] {
      fail(at, "the scene has no parameter {}{}", in_quotes(name), suggest(name, names()));
    });
  }
}

std::string Parameters::replaced(const XmlAttribute& attribute) const {
  const std::string& text = attribute.written;
  std::string out;
  std::size_t from = 0;
  for (std::size_t dollar = text.find('$'); dollar != std::string::npos;
       dollar = text.find('$', from)) {
    const std::size_t end =
        std::min(text.find_first_not_of(name_characters, dollar + 1), text.size());
    const std::string name = text.substr(dollar + 1, end - dollar - 1);
    const auto value = values_.find(name);
    if (value == values_.end()) {
      fail(attribute.value_at, "no <default> above declares the parameter {}{}",
           in_quotes("$" + name), suggest("$" + name, with_dollar(names())));
    }
    out += text.substr(from, dollar - from) + value->second;
    from = end;
  }
  return out + text.substr(from);
}

std::vector<std::string> Parameters::names() const {
  std::vector<std::string> out;
  for (const auto& [name, value] : values_)
    out.push_back(name);
  return out;
}

}  // namespace carlo
