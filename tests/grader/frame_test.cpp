#include "grader/protocol/frame.h"

#include "cli/error.h"
#include "grader/protocol/params.h"
#include "grader/protocol/rows_text.h"
#include "random/rng.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>

using namespace carlo::grader;

namespace {

const Frame table{Frame::Status::rows, {2, {1.5, -0.0, 3, 4}}, {}};
const Frame text{Frame::Status::error, {}, "n must be positive"};

}  // namespace

TEST_CASE("a frame survives the way there and back", "[frame]") {
  const std::optional<Frame> back = decode(encode(table));
  REQUIRE(back.has_value());
  CHECK(back->rows.columns == 2);
  CHECK(back->rows.values == table.rows.values);
  CHECK(back->rows.count() == 2);
  CHECK(decode(encode(text))->text == text.text);
  CHECK(decode(encode({}))->rows.count() == 0);
}

TEST_CASE("a frame that is cut short or too long is refused", "[frame]") {
  for (const Frame& frame : {table, text}) {
    const std::string bytes = encode(frame);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      CHECK_FALSE(decode(bytes.substr(0, length)).has_value());
    }
    CHECK_FALSE(decode(bytes + 'x').has_value());
    CHECK_FALSE(decode(bytes + bytes).has_value());
  }
}

TEST_CASE("a frame with impossible sizes is refused", "[frame]") {
  // Status, columns, rows and bytes of payload stand at these offsets; all ones overflow any
  // product that is not checked.
  for (const std::size_t offset : {8U, 12U, 16U, 24U}) {
    std::string bytes = encode(table);
    for (std::size_t i = 0; i < 4; ++i)
      bytes[offset + i] = '\xFF';
    CHECK_FALSE(decode(bytes).has_value());
  }
}

TEST_CASE("a frame of random bytes is refused or consistent", "[frame]") {
  carlo::Rng rng(7);
  const std::string good = encode(table);
  for (int trial = 0; trial < 20'000; ++trial) {
    std::string bytes = good;
    for (int change = 0; change < 3; ++change) {
      bytes[8 + rng.next_u32() % (bytes.size() - 8)] = static_cast<char>(rng.next_u32());
    }
    const std::optional<Frame> frame = decode(bytes);
    if (!frame) continue;
    CHECK(frame->rows.count() * frame->rows.columns == frame->rows.values.size());
  }
}

TEST_CASE("parameters survive the way there and back, bit by bit", "[params]") {
  const Params params{.seed = 0xFFFF'FFFF'FFFF'FFFF,
                      .n = -3,
                      .numbers = {{"third", 1.0 / 3}, {"tiny", 0x1p-1070}, {"k", 4}}};
  const Params back = params_from_json(to_json(params));
  CHECK(back.seed == params.seed);
  CHECK(back.n == params.n);
  CHECK(back.numbers == params.numbers);
  CHECK(back.whole("k") == 4);
}

TEST_CASE("parameters that are missing or of a wrong kind are errors", "[params]") {
  const Params params{.numbers = {{"half", 0.5}}};
  CHECK_THROWS_AS(params["a"], carlo::Error);
  CHECK_THROWS_AS(params.whole("half"), carlo::Error);
  CHECK_THROWS_AS(params_from_json("{"), carlo::Error);
  CHECK_THROWS_AS(params_from_json("{}"), carlo::Error);
  CHECK_THROWS_AS(params_from_json(R"({"seed": "x", "n": 1, "numbers": {}})"), carlo::Error);
}

TEST_CASE("values are shown beside their names, and numbered where they have none", "[rows]") {
  const auto squeezed = [](const std::string& spaced) {
    std::string out;
    for (const char c : spaced) {
      if (c != ' ' || out.empty() || out.back() != ' ') out += c;
    }
    return out;
  };
  const Rows row{2, {0.5, 3}};
  CHECK(squeezed(rows_text(row, {"mean", "count"}, 0)) ==
        "2 values came back:\n mean 0.5\n count 3\n");
  // As many names as there are columns, or none.
  CHECK(squeezed(rows_text(row, {"mean"}, 0)) == "2 values came back:\n value 1 0.5\n value 2 3\n");
  const Rows list{1, {0.1, 2, 4, 8}};
  CHECK(squeezed(rows_text(list, {}, 2)) ==
        "4 values came back; the first 2:\n value 1 0.1\n value 2 2\n ... 2 more: --all\n");
  // The last name of a list is that of all that follow.
  CHECK(squeezed(rows_text(list, {"mean", "point"}, 0)) ==
        "4 values came back:\n mean 0.1\n point 1 2\n point 2 4\n point 3 8\n");
  CHECK(squeezed(rows_text({1, {7}}, {"hits"}, 10)) == "1 value came back:\n hits 7\n");
  const Rows pairs{2, {0.5, 1, 0.25, 2}};
  CHECK(squeezed(rows_text(pairs, {"lower", "upper"}, 0)) ==
        "2 rows of 2 values came back:\n row lower upper\n 1 0.5 1\n 2 0.25 2\n");
  CHECK(squeezed(rows_text(pairs, {}, 1)) ==
        "2 rows of 2 values came back; the first 1:\n row value 1 value 2\n 1 0.5 1\n"
        " ... 1 more: --all\n");
  CHECK(rows_text({1, {}}, {"hits"}, 10) == "no values came back\n");
  CHECK(rows_text({}, {}, 10) == "no rows came back\n");
}
