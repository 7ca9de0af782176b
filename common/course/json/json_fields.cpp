#include "course/json/json_fields.h"

#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace carlo {
namespace {

using nlohmann::json;

std::string dumped(const json& value, int indent = -1) {
  return value.dump(indent, ' ', false, json::error_handler_t::replace);
}

/// Returns the beginning of a value, for a message. Nothing for a list: writing it out takes a
/// stack as deep as the list.
std::string shown(const json& value) {
  if (value.is_array()) return "a list";
  if (value.is_object()) return "an object";
  const std::string text = dumped(value);
  return text.size() <= 40 ? text : text.substr(0, 40) + " ...";
}

std::optional<double> number_in(const json& value) {
  if (value.is_number()) return value.get<double>();
  if (value == "inf") return HUGE_VAL;
  if (value == "-inf") return -HUGE_VAL;
  if (value == "nan") return std::nan("");
  return std::nullopt;
}

json number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

}  // namespace

JsonFields::JsonFields(json& object, bool reading, const JsonFields* parent, std::string place)
    : object_(object), reading_(reading), parent_(parent), place_(std::move(place)) {
  if (!object_.is_object()) fail("expected an object, got " + shown(object_));
}

void JsonFields::fail(const std::string& what) const {
  std::string where = place_;
  for (const JsonFields* outer = parent_; outer != nullptr; outer = outer->parent_)
    where = fmt::format("{}{}{}", outer->place_, outer->parent_ == nullptr ? ": " : ".", where);
  throw Error("{}: {}", where, what);
}

bool JsonFields::has(const char* name) const {
  return object_.contains(name);
}

std::vector<std::string> JsonFields::names() const {
  std::vector<std::string> names;
  for (const auto& [name, value] : object_.items())
    names.push_back(name);
  return names;
}

json& JsonFields::member(const char* name) {
  if (!reading_) return object_[name];
  const auto found = object_.find(name);
  if (found == object_.end()) fail(fmt::format("\"{}\" is missing", name));
  return *found;
}

void JsonFields::operator()(const char* name, bool& value) {
  json& found = member(name);
  if (!reading_) {
    found = value;
    return;
  }
  if (!found.is_boolean()) {
    fail(fmt::format("\"{}\" must be true or false, got {}", name, shown(found)));
  }
  value = found.get<bool>();
}

template <class Number>
void JsonFields::whole(const char* name, Number& value) {
  json& found = member(name);
  if (!reading_) {
    found = value;
    return;
  }
  const std::optional<Number> read =
      found.is_number_integer() ? number_of<Number>(dumped(found)) : std::nullopt;
  if (!read) {
    fail(fmt::format("\"{}\" must be a whole number from {} to {}, got {}", name,
                     std::numeric_limits<Number>::min(), std::numeric_limits<Number>::max(),
                     shown(found)));
  }
  value = *read;
}

void JsonFields::operator()(const char* name, int& value) {
  whole(name, value);
}

void JsonFields::operator()(const char* name, unsigned long& value) {
  whole(name, value);
}

void JsonFields::operator()(const char* name, double& value) {
  json& found = member(name);
  if (!reading_) {
    found = number(value);
    return;
  }
  const std::optional<double> read = number_in(found);
  if (!read) fail(fmt::format("\"{}\" must be a number, got {}", name, shown(found)));
  value = *read;
}

void JsonFields::operator()(const char* name, std::string& value) {
  json& found = member(name);
  if (!reading_) {
    found = value;
    return;
  }
  if (!found.is_string()) fail(fmt::format("\"{}\" must be a text, got {}", name, shown(found)));
  value = found.get_ref<const std::string&>();
}

void JsonFields::operator()(const char* name, JsonScalar& value) {
  json& found = member(name);
  if (!reading_) {
    found = nullptr;
    if (auto* text = std::get_if<std::string>(&value)) (*this)(name, *text);
    if (auto* number = std::get_if<double>(&value)) (*this)(name, *number);
  } else if (found.is_string()) {
    value = found.get_ref<const std::string&>();
  } else if (found.is_number()) {
    value = found.get<double>();
  } else if (found.is_null()) {
    value = {};
  } else {
    fail(fmt::format("\"{}\" must be a text, a number or null, got {}", name, shown(found)));
  }
}

void JsonFields::operator()(const char* name, std::vector<double>& list) {
  list.resize(begin_list(name, list.size()));
  json& found = member(name);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!reading_) {
      found[i] = number(list[i]);
      continue;
    }
    const std::optional<double> read = number_in(found[i]);
    if (!read) fail(fmt::format("\"{}\" must list numbers, got {}", name, shown(found[i])));
    list[i] = *read;
  }
}

void JsonFields::operator()(const char* name, std::vector<std::string>& list) {
  if (!reading_) {
    member(name) = list;
    return;
  }
  list.resize(begin_list(name, list.size()));
  const json& found = member(name);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!found[i].is_string()) {
      fail(fmt::format("\"{}\" must list texts, got {}", name, shown(found[i])));
    }
    list[i] = found[i].get_ref<const std::string&>();
  }
}

void JsonFields::as_text(const char* name, std::uint64_t& value) {
  std::string text = reading_ ? "" : std::to_string(value);
  (*this)(name, text);
  const std::optional<std::uint64_t> read = number_of<std::uint64_t>(text);
  if (!read) fail(fmt::format("\"{}\" must be a number as text, got \"{}\"", name, text));
  value = *read;
}

void JsonFields::null(const char* name) {
  if (!reading_) member(name) = nullptr;
}

JsonFields JsonFields::object(const char* name) {
  json& found = member(name);
  if (!reading_) found = json::object();
  return {found, reading_, this, name};
}

std::size_t JsonFields::begin_list(const char* name, std::size_t count) {
  json& found = member(name);
  if (!reading_) found = json::array_t(count);
  if (!found.is_array()) fail(fmt::format("\"{}\" must be a list, got {}", name, shown(found)));
  return found.size();
}

JsonFields JsonFields::element(const char* name, std::size_t i) {
  json& found = member(name)[i];
  if (!reading_) found = json::object();
  return {found, reading_, this, fmt::format("{}[{}]", name, i)};
}

JsonDocument::JsonDocument() : root_(std::make_unique<json>(json::object())) {}

JsonDocument::JsonDocument(const std::string& text, const std::string& name) : name_(name) {
  try {
    root_ = std::make_unique<json>(json::parse(text));
  } catch (const json::parse_error& error) {
    throw Error("{}: not valid JSON at byte {}", name, error.byte);
  } catch (const json::out_of_range& error) {
    throw Error("{}: a number is too large: {}", name, error.what());
  }
}

JsonDocument::~JsonDocument() = default;

JsonFields JsonDocument::writing() {
  return {*root_, false, nullptr, name_};
}

JsonFields JsonDocument::reading() {
  return {*root_, true, nullptr, name_};
}

std::string JsonDocument::text(int indent) const {
  return dumped(*root_, indent);
}

std::string valid_utf8(const std::string& text) {
  return json::parse(dumped(text)).get<std::string>();
}

}  // namespace carlo
