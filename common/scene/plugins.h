#pragma once

#include "scene/xml_source.h"

#include <string_view>
#include <vector>

namespace carlo {

/// How a property is treated.
enum class Treatment {
  read,
  none,    ///< accepted: it does not affect the image
  noted,   ///< accepted, with a note on why it has no effect
  refused  ///< an error that says why
};

/// A property that a plugin may have.
struct Rule {
  std::string_view name;  ///< Mitsuba 0.6's (names.h)
  void (*check)(const XmlElement& property);
  Treatment treatment = Treatment::read;
  std::string_view why = {};       ///< for what is noted or refused
  std::string_view required = {};  ///< the kind of element, if it must be given
};

/// An element <element type="..."> of a scene.
struct Plugin {
  std::string_view element, type;
  std::string_view within;                ///< the element in which it may stand; empty for any
  std::vector<std::string_view> objects;  ///< the objects, besides properties, that may stand
                                          ///< inside
  std::vector<Rule> rules;
  std::string_view as = {};   ///< the type of the plugin that replaces it
  std::string_view why = {};  ///< the explanation of that
};

/// All supported plugins with all their properties: anything else is an error.
const std::vector<Plugin>& plugins();

/// The plugin for an element inside `within`; null if there is none.
const Plugin* find_plugin(std::string_view element, std::string_view type, std::string_view within);

/// The rule for the property that Mitsuba 0.6 calls `name`; null if there is none.
const Rule* find_rule(const Plugin& plugin, std::string_view name);

}  // namespace carlo
