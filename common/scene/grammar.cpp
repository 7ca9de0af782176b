#include "scene/grammar.h"

#include "scene/checks.h"
#include "scene/names.h"
#include "scene/plugins.h"
#include "scene/text.h"
#include "scene/transforms.h"

#include <algorithm>
#include <array>
#include <set>

namespace carlo {
namespace {

constexpr std::array property_kinds = {"float", "integer",  "boolean", "string", "rgb",
                                       "srgb",  "spectrum", "point",   "vector", "transform"};

class Grammar {
 public:
  Grammar(SceneErrors& errors, std::vector<std::string>& notes) : errors_(errors), notes_(notes) {}

  void check(XmlElement& object, std::string_view within) {
    const std::size_t before = errors_.count();
    bool all_known = !object.broken;
    object.allow_only({"type", "id", "name"}, errors_);
    errors_.guard([&] { find_type(object, within); });
    std::set<std::string> given;
    for (XmlElement& child : object.children) {
      if (!is_property(child)) continue;
      const XmlAttribute* name = child.find("name");
      all_known = all_known && name != nullptr && !name->broken;
      object.broken = object.broken || any_broken(child);
      errors_.guard([&] { check_property(child, object, given); });
    }
    object.broken = object.broken || errors_.count() > before;
    all_known = check_objects(object) && all_known;
    // An element that seems to be missing may be one of the unknown ones.
    if (object.plugin != nullptr && all_known) check_required(object, given);
  }

 private:
  void find_type(XmlElement& object, std::string_view within) {
    const XmlAttribute& type = object.get("type");
    if (type.broken) return;
    object.plugin = find_plugin(object.name, type.value, within);
    if (object.plugin == nullptr) fail_type(object, type, within);
    const Plugin& plugin = *object.plugin;
    if (!plugin.as.empty()) {
      note("{} {} is taken as {}: {}", object.name, in_quotes(type.value), in_quotes(plugin.as),
           plugin.why);
    }
  }

  [[noreturn]] static void fail_type(const XmlElement& object, const XmlAttribute& type,
                                     std::string_view within) {
    std::vector<std::string> known;
    for (const Plugin& plugin : plugins()) {
      if (plugin.element == object.name && (plugin.within.empty() || plugin.within == within))
        known.emplace_back(plugin.type);
    }
    fail(type.value_at, "{} {} {}{}", object.name, in_quotes(type.value),
         what_is_wrong(object.name, type.value, within), suggest(type.value, known));
  }

  /// Only what may stand elsewhere is out of place; anything else is unknown everywhere.
  static std::string_view what_is_wrong(std::string_view element, std::string_view type,
                                        std::string_view within) {
    const auto fits = [&](const Plugin& p) { return p.element == element && p.type == type; };
    if (std::none_of(plugins().begin(), plugins().end(), fits)) return "is not supported";
    if (within == "sdf") return "cannot stand inside an sdf";
    if (within == "shape") return "cannot stand inside a <shape>";
    return element == "shape" ? "is not supported outside an sdf"
                              : "is not supported outside a <shape>";
  }

  void check_required(XmlElement& object, const std::set<std::string>& given) {
    for (const Rule& rule : object.plugin->rules) {
      if (rule.required.empty() || given.count(std::string(rule.name)) != 0) continue;
      object.broken = true;
      const auto meant = [&](const std::string& name) {
        return find_rule(*object.plugin, name) == nullptr && is_near(name, rule.name);
      };
      if (std::any_of(given.begin(), given.end(), meant)) continue;
      errors_.guard([&] { fail_missing(object, rule.name, rule.required); });
    }
  }

  static bool any_broken(const XmlElement& property) {
    return property.broken || std::any_of(property.children.begin(), property.children.end(),
                                          [](const XmlElement& step) { return step.broken; });
  }

  void check_property(XmlElement& property, const XmlElement& object,
                      std::set<std::string>& given) {
    property.get("name");
    XmlAttribute& name = *std::find_if(property.attributes.begin(), property.attributes.end(),
                                       [](const XmlAttribute& a) { return a.name == "name"; });
    if (name.broken) return;
    const std::string written = name.value;
    name.value = mitsuba06_name(written);
    if (!given.insert(name.value).second)
      fail(property.at, "property {} is given twice", in_quotes(written));
    if (object.plugin == nullptr) return;
    const Rule* rule = find_rule(*object.plugin, name.value);
    if (rule == nullptr) fail_unknown(property, object, written);
    if (rule->treatment == Treatment::refused)
      fail(property.at, "{} is not supported: {}", written, rule->why);
    if (!check_parts(property, errors_) || property.broken) return;
    rule->check(property);
    if (rule->treatment == Treatment::noted) note("{} has no effect: {}", written, rule->why);
    if (property.name != "transform") return;
    for (const std::string& text : notes_on_steps(property))
      note("{}", text);
  }

  [[noreturn]] static void fail_unknown(const XmlElement& property, const XmlElement& object,
                                        const std::string& name) {
    // The names as in this file, or in the style of its author.
    const bool new_names = name.find('_') != std::string::npos;
    const Dialect dialect = new_names ? Dialect::mitsuba3 : object.at.source->dialect;
    std::vector<std::string> taken, read;
    for (const Rule& rule : object.plugin->rules) {
      if (rule.treatment == Treatment::refused) continue;
      taken.push_back(name_in(dialect, rule.name));
      if (rule.treatment == Treatment::read) read.push_back(taken.back());
    }
    std::string hint = suggest(name, taken);
    if (hint.find("did you mean") == std::string::npos) hint = suggest(name, read);
    fail(property.at, "<{} type={}> has no property {}{}", object.name,
         in_quotes(object.get("type").value), in_quotes(name), hint);
  }

  /// Checks that each of them may stand there; returns true if so.
  bool check_objects(XmlElement& object) {
    std::set<std::string> given;
    bool all_known = true;
    for (XmlElement& child : object.children) {
      if (is_property(child)) continue;
      // For an unknown object its own error is enough, but materials inside are checked.
      if (object.plugin == nullptr && child.name != "bsdf" && child.name != "ref") {
        child.broken = true;
        continue;
      }
      if (!errors_.guard([&] { check_place(child, object, given); })) {
        object.broken = child.broken = true;
        all_known = false;
        continue;
      }
      if (child.name == "ref") {
        child.allow_only({"id", "name"}, errors_);
        child.allow_nothing_inside(errors_);
      } else {
        check(child, child.name == "shape" ? "sdf" : object.name);
      }
    }
    return all_known;
  }

  /// Throws Error at an element that may not stand inside `object`, or not twice.
  static void check_place(const XmlElement& child, const XmlElement& object,
                          std::set<std::string>& given) {
    const auto type = [&] { return in_quotes(object.get("type").value); };
    if (object.plugin == nullptr) return;
    const auto& allowed = object.plugin->objects;
    if (std::find(allowed.begin(), allowed.end(), child.name) == allowed.end()) {
      fail(child.at, "<{}> cannot stand inside <{} type={}>{}", child.name, object.name, type(),
           suggest(child.name, {property_kinds.begin(), property_kinds.end()}));
    }
    if (child.name != "shape" && !given.insert(child.name).second)
      fail(child.at, "a second <{}> inside <{} type={}>, expected one", child.name, object.name,
           type());
  }

  template <class... Args>
  void note(fmt::format_string<Args...> format, Args&&... args) {
    const std::string text = fmt::format(format, std::forward<Args>(args)...);
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.push_back(text);
  }

  SceneErrors& errors_;
  std::vector<std::string>& notes_;
};

}  // namespace

bool is_property(const XmlElement& element) {
  return std::find(property_kinds.begin(), property_kinds.end(), element.name) !=
         property_kinds.end();
}

void check_object(XmlElement& object, std::string_view within, SceneErrors& errors,
                  std::vector<std::string>& notes) {
  Grammar(errors, notes).check(object, within);
}

void fail_missing(const XmlElement& object, std::string_view property, std::string_view kind) {
  fail(object.at, "<{} type={}> needs <{} name={} .../>", object.name,
       in_quotes(object.get("type").value), kind, in_quotes(property));
}

}  // namespace carlo
