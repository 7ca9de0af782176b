#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// An object of a JSON document that is written or read. A type tells once what its members are
/// called, for both:
///
///   void fields(JsonFields& json, Diagnosis& diagnosis) {
///     json("id", diagnosis.id);
///     json("sentence", diagnosis.sentence);
///   }
///
/// Reading throws Error, one line that names the place and what was expected, when a member is
/// missing or of another kind; members that nobody asks for are passed over. nlohmann's library
/// does the work; its header costs seconds of compiling, so that one file includes it for all.
class JsonFields {
 public:
  bool reading() const { return reading_; }
  /// Whether there is such a member.
  bool has(const char* name) const;

  void operator()(const char* name, bool& value);
  void operator()(const char* name, int& value);
  void operator()(const char* name, unsigned long& value);
  /// Infinities and NaN are the texts "inf", "-inf" and "nan".
  void operator()(const char* name, double& value);
  /// Bytes that are no UTF-8 are written as U+FFFD.
  void operator()(const char* name, std::string& value);
  void operator()(const char* name, std::vector<double>& list);
  void operator()(const char* name, std::vector<std::string>& list);

  /// An object with members of its own, which fields() names.
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

  /// An object whose members are called as they like.
  template <class T>
  void operator()(const char* name, std::map<std::string, T>& members) {
    JsonFields inner = object(name);
    if (reading_) members.clear();
    for (const std::string& key : inner.names())
      members[key];
    for (auto& [key, value] : members)
      inner(key.c_str(), value);
  }

  /// A member that may be missing.
  template <class T>
  void operator()(const char* name, std::optional<T>& value) {
    if (reading_) value = has(name) ? std::optional<T>(T{}) : std::nullopt;
    if (value) (*this)(name, *value);
  }

  /// A value of an enum, by its name; `named` throws Error when there is none.
  template <class Enum>
  void named(const char* name, Enum& value, std::string (*name_of)(Enum),
             Enum (*value_of)(const std::string&)) {
    std::string text = reading_ ? "" : name_of(value);
    (*this)(name, text);
    if (reading_) value = value_of(text);
  }

  /// A number of 64 bits as text: many readers of JSON round it.
  void as_text(const char* name, std::uint64_t& value);

  /// What others want to read, and we do not: sums.
  template <class T>
  void also(const char* name, T value) {
    if (!reading_) (*this)(name, value);
  }
  void also(const char* name, const char* text) { also(name, std::string(text)); }
  void null(const char* name);

  /// Throws Error: the place, then `what`.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  friend class JsonDocument;
  JsonFields(nlohmann::json& object, bool reading, const JsonFields* parent, std::string place);

  /// Of all members, in the order of the alphabet.
  std::vector<std::string> names() const;
  JsonFields object(const char* name);
  std::size_t begin_list(const char* name, std::size_t count);
  JsonFields element(const char* name, std::size_t i);
  nlohmann::json& member(const char* name);
  template <class Number>
  void whole(const char* name, Number& value);

  nlohmann::json& object_;
  bool reading_;
  const JsonFields* parent_;  ///< what it is a part of; none of the whole document
  std::string place_;         ///< in that
};

/// A whole document, which is one object.
class JsonDocument {
 public:
  JsonDocument();
  /// Throws Error that begins with `name` when the text is none.
  JsonDocument(const std::string& text, const std::string& name);
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;
  ~JsonDocument();

  JsonFields writing();
  JsonFields reading();
  /// In one line, or in lines that are indented by `indent` for each level. Valid UTF-8.
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

/// Throws Error that begins with `name`: a file's, or what the text should be.
template <class T>
T from_json_text(const std::string& text, const std::string& name) {
  JsonDocument document(text, name);
  JsonFields root = document.reading();
  T value{};
  fields(root, value);
  return value;
}

/// The text with U+FFFD in place of bytes that are no UTF-8.
std::string valid_utf8(const std::string& text);

}  // namespace carlo
