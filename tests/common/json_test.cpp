#include "course/json/json_fields.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace carlo;

namespace {

enum class Size { small, large };
std::string to_string(Size size) {
  return size == Size::small ? "small" : "large";
}
Size size_named(const std::string& name) {
  if (name == "small") return Size::small;
  if (name == "large") return Size::large;
  throw Error("no size is called {}", name);
}

struct Part {
  std::string name;
  double weight = 0;
};

void fields(JsonFields& json, Part& part) {
  json("name", part.name);
  json("weight", part.weight);
}

struct Whole {
  bool good = false;
  int count = 0;
  std::size_t bytes = 0;
  std::uint64_t seed = 0;
  Size size = Size::small;
  std::vector<double> numbers;
  std::vector<std::string> words;
  std::vector<Part> parts;
  std::map<std::string, int> seen;
  std::optional<Part> more;
};

void fields(JsonFields& json, Whole& whole) {
  json("good", whole.good);
  json("count", whole.count);
  json("bytes", whole.bytes);
  json.as_text("seed", whole.seed);
  json.named("size", whole.size, to_string, size_named);
  json("numbers", whole.numbers);
  json("words", whole.words);
  json("parts", whole.parts);
  json("seen", whole.seen);
  json("more", whole.more);
  json.also("sum", whole.count + 1);
}

Whole full() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {true,
          -7,
          std::numeric_limits<std::size_t>::max(),
          std::numeric_limits<std::uint64_t>::max(),
          Size::large,
          {0.1, -infinity, infinity, std::nan(""), 5e-324, -0.0},
          {"", "a\xFF", "\"\n"},
          {{"first", 1}, {"second", 2}},
          {{"1.2", 3}, {"", -1}},
          Part{"third", 3}};
}

/// The full document with one text replaced by another.
std::string with(const std::string& from, const std::string& to) {
  std::string text = json_text(full());
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text) {
  try {
    from_json_text<Whole>(text, "whole.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("what is written is read again, member by member", "[json]") {
  const Whole before = full(), back = from_json_text<Whole>(json_text(full(), 2), "it");
  CHECK(back.good);
  CHECK(back.count == -7);
  CHECK(back.bytes == before.bytes);
  CHECK(back.seed == before.seed);
  CHECK(back.size == Size::large);
  REQUIRE(back.numbers.size() == 6);
  for (const std::size_t i : {0U, 1U, 2U, 4U, 5U})
    CHECK(back.numbers[i] == before.numbers[i]);
  CHECK(std::isnan(back.numbers[3]));
  CHECK(std::signbit(back.numbers[5]));
  CHECK(back.words == std::vector<std::string>{"", "a\xEF\xBF\xBD", "\"\n"});
  REQUIRE(back.parts.size() == 2);
  CHECK(back.parts[1].name == "second");
  CHECK(back.seen == before.seen);
  REQUIRE(back.more.has_value());
  CHECK(back.more->weight == 3);
  CHECK_FALSE(from_json_text<Whole>(json_text(Whole{}), "it").more.has_value());
}

TEST_CASE("a member that is missing or of another kind is one line with its place", "[json]") {
  CHECK(error_of(with("\"count\":-7", "\"count\":-7")) == "no error");
  CHECK(error_of(with("\"count\":-7", "\"other\":1")) == "whole.json: \"count\" is missing");
  CHECK(error_of(with("\"count\":-7", "\"count\":-7.5")) ==
        "whole.json: \"count\" must be a whole number from -2147483648 to 2147483647, got -7.5");
  CHECK(error_of(with("\"count\":-7", "\"count\":2147483648")).ends_with("got 2147483648"));
  CHECK(error_of(with("\"bytes\":1", "\"bytes\":-1")).find("\"bytes\" must be") < 20);
  CHECK(error_of(with("\"good\":true", "\"good\":1")) ==
        "whole.json: \"good\" must be true or false, got 1");
  CHECK(error_of(with("\"seed\":\"1", "\"seed\":\"-1")).find("must be a number as text") < 30);
  CHECK(error_of(with("\"large\"", "\"huge\"")) == "no size is called huge");
  CHECK(error_of(with("\"nan\"", "\"none\"")) ==
        "whole.json: \"numbers\" must list numbers, got \"none\"");
  CHECK(error_of(with("\"nan\"", "[]")).ends_with("got a list"));
  CHECK(error_of(with("\"second\"", "null")) ==
        "whole.json: parts[1]: \"name\" must be a text, got null");
  CHECK(error_of(with("{\"name\":\"second\",\"weight\":2.0}", "2")) ==
        "whole.json: parts[1]: expected an object, got 2");
  CHECK(error_of(with("\"third\"", "3")).starts_with("whole.json: more: \"name\""));
}

TEST_CASE("a text that is no document is one line that says so", "[json]") {
  CHECK(error_of("") == "whole.json: not valid JSON at byte 1");
  CHECK(error_of("{\"a\": 1,}").starts_with("whole.json: not valid JSON at byte"));
  CHECK(error_of("[]") == "whole.json: expected an object, got a list");
  CHECK(error_of("{\"count\": 1e999}").starts_with("whole.json: a number is too large"));
  // Nested as deep as the text is long: the stack must not overflow.
  CHECK(error_of(std::string(1'000'000, '[')).starts_with("whole.json: not valid JSON"));
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  CHECK(error_of(with("-7", deep)).find("\"count\" must be") < 20);
}
