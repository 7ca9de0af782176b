#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace carlo {

/// A text or a number; neither for null.
using JsonScalar = std::variant<std::monostate, std::string, double>;

/// An object of a JSON document that is written or read. A type names its members once, for both:
///
///   void fields(JsonFields& json, Diagnosis& diagnosis) {
///     json("id", diagnosis.id);
///     json("sentence", diagnosis.sentence);
///   }
///
/// Reading throws Error, one line with the place and what was expected, if a member is missing or
/// of another kind; members that nobody asks for are ignored. Uses nlohmann's library, whose header
/// costs seconds of compiling, so only one file includes it.
class JsonFields {
 public:
  bool reading() const { return reading_; }
  /// Returns whether there is such a member.
  bool has(const char* name) const;

  void operator()(const char* name, bool& value);
  void operator()(const char* name, int& value);
  void operator()(const char* name, unsigned long& value);
  /// Infinities and NaN are written as the texts "inf", "-inf" and "nan".
  void operator()(const char* name, double& value);
  /// Invalid UTF-8 is written as U+FFFD.
  void operator()(const char* name, std::string& value);
  void operator()(const char* name, JsonScalar& value);
  void operator()(const char* name, std::vector<double>& list);
  void operator()(const char* name, std::vector<std::string>& list);

  /// An object whose members fields() names.
  template <class T>
  void operator()(const char* name, T& value) {
    JsonFields inner = object(name);
    fields(inner, value);
  }

  template <class T>
  void operator()(const char* name, std::vector<T>& list) {
    list.resize(begin_list(name, list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) {
      JsonFields inner = element(name, i);
      fields(inner, list[i]);
    }
  }

  /// An object with arbitrary member names.
  template <class T>
  void operator()(const char* name, std::map<std::string, T>& members) {
    JsonFields inner = object(name);
    inner.all(members);
  }

  /// All members of this object, whatever their names.
  template <class T>
  void all(std::map<std::string, T>& members) {
    if (reading_) members.clear();
    for (const std::string& key : names())
      members[key];
    for (auto& [key, value] : members)
      (*this)(key.c_str(), value);
  }

  /// A member that may be missing.
  template <class T>
  void operator()(const char* name, std::optional<T>& value) {
    if (reading_) value = has(name) ? std::optional<T>(T{}) : std::nullopt;
    if (value) (*this)(name, *value);
  }

  /// A value of an enum, by its name; `named` throws Error if there is none.
  template <class Enum>
  void named(const char* name, Enum& value, std::string (*name_of)(Enum),
             Enum (*value_of)(const std::string&)) {
    std::string text = reading_ ? "" : name_of(value);
    (*this)(name, text);
    if (reading_) value = value_of(text);
  }

  /// Writes a 64-bit number as text, because many readers of JSON round it.
  void as_text(const char* name, std::uint64_t& value);

  /// Writes a value that we never read back, such as a sum.
  template <class T>
  void also(const char* name, T value) {
    if (!reading_) (*this)(name, value);
  }
  void also(const char* name, const char* text) { also(name, std::string(text)); }
  void null(const char* name);

  /// Throws Error: the place followed by `what`.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  friend class JsonDocument;
  JsonFields(nlohmann::json& object, bool reading, const JsonFields* parent, std::string place);

  /// Returns all members' names in alphabetical order.
  std::vector<std::string> names() const;
  JsonFields object(const char* name);
  std::size_t begin_list(const char* name, std::size_t count);
  JsonFields element(const char* name, std::size_t i);
  nlohmann::json& member(const char* name);
  template <class Number>
  void whole(const char* name, Number& value);

  nlohmann::json& object_;
  bool reading_;
  const JsonFields* parent_;  ///< the object that contains it; null for the whole document
  std::string place_;         ///< its place in the parent
};

/// A whole document: one object.
class JsonDocument {
 public:
  JsonDocument();
  /// Throws Error that begins with `name` if the text is not a JSON object.
  JsonDocument(const std::string& text, const std::string& name);
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;
  ~JsonDocument();

  JsonFields writing();
  JsonFields reading();
  /// Returns the document in one line, or in lines indented by `indent` per level. Valid UTF-8.
  std::string text(int indent = -1) const;

 private:
  std::unique_ptr<nlohmann::json> root_;
  std::string name_;
};

template <class T>
std::string json_text(T value, int indent = -1) {
  JsonDocument document;
  JsonFields root = document.writing();
  fields(root, value);
  return document.text(indent);
}

/// Throws Error that begins with `name`: a file's name, or what the text should be.
template <class T>
T from_json_text(const std::string& text, const std::string& name) {
  JsonDocument document(text, name);
  JsonFields root = document.reading();
  T value{};
  fields(root, value);
  return value;
}

/// Returns the text with invalid UTF-8 replaced by U+FFFD.
std::string valid_utf8(const std::string& text);

}  // namespace carlo
