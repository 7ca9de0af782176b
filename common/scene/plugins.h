#pragma once

#include "scene/xml_source.h"

#include <string_view>
#include <vector>

namespace carlo {

/// What becomes of a property.
enum class Treatment {
  read,
  none,    ///< taken: it changes nothing in an image
  noted,   ///< taken, but it is told why it changes nothing
  refused  ///< an error that says why
};

/// A property that a plugin may have.
struct Rule {
  std::string_view name;  ///< Mitsuba 0.6's (names.h)
  void (*check)(const XmlElement& property);
  Treatment treatment = Treatment::read;
  std::string_view why = {};       ///< of what is noted or refused
  std::string_view required = {};  ///< the kind of element, of what must be given
};

/// What stands in a scene as <element type="...">.
struct Plugin {
  std::string_view element, type;
  std::string_view within;                ///< the element in which it may stand; empty for any
  std::vector<std::string_view> objects;  ///< what besides properties may stand inside
  std::vector<Rule> rules;
  std::string_view as = {};   ///< the plugin's type that is taken in its place
  std::string_view why = {};  ///< what is told of that
};

/// All that are understood, with all of their properties: what is not here is an error.
const std::vector<Plugin>& plugins();

/// The plugin for an element inside `within`; null if there is none.
const Plugin* find_plugin(std::string_view element, std::string_view type, std::string_view within);

/// The rule for the property that Mitsuba 0.6 calls `name`; null if there is none.
const Rule* find_rule(const Plugin& plugin, std::string_view name);

}  // namespace carlo
