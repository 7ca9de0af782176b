#include "grader/protocol/frame.h"

#include "grader/protocol/params.h"
#include "grader/protocol/rows_text.h"
#include "random/rng.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace carlo::grader;

namespace {

const Frame table{Frame::Status::rows, {2, {1.5, -0.0, 3, 4}}, {}};
const Frame text{Frame::Status::error, {}, "n must be positive"};
const Frame exhausted{Frame::Status::exhausted, {}, "no thread"};

}  // namespace

TEST_CASE("a frame survives the way there and back", "[frame]") {
  const std::optional<Frame> back = decode(encode(table));
  REQUIRE(back.has_value());
  CHECK(back->rows.columns == 2);
  CHECK(back->rows.values == table.rows.values);
  CHECK(back->rows.count() == 2);
  for (const Frame& frame : {text, exhausted}) {
    CHECK(decode(encode(frame))->text == frame.text);
    CHECK(decode(encode(frame))->status == frame.status);
  }
  CHECK(decode(encode({}))->rows.count() == 0);
}

TEST_CASE("a frame that is cut short or too long is refused", "[frame]") {
  for (const Frame& frame : {table, text, exhausted}) {
    const std::string bytes = encode(frame);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      CHECK_FALSE(decode(bytes.substr(0, length)).has_value());
    }
    CHECK_FALSE(decode(bytes + 'x').has_value());
    CHECK_FALSE(decode(bytes + bytes).has_value());
  }
}

TEST_CASE("a frame with impossible sizes is refused", "[frame]") {
  // Status, columns, rows and bytes of payload are at these offsets; all ones overflow any
  // unchecked product.
  for (const std::size_t offset : {8U, 12U, 16U, 24U}) {
    std::string bytes = encode(table);
    for (std::size_t i = 0; i < 4; ++i)
      bytes[offset + i] = '\xFF';
    CHECK_FALSE(decode(bytes).has_value());
  }
  for (const std::size_t offset : {12U, 16U}) {  // a text has neither columns nor rows
    for (const Frame& frame : {text, exhausted}) {
      std::string bytes = encode(frame);
      bytes[offset] = 1;
      CHECK_FALSE(decode(bytes).has_value());
    }
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
  const Params params{
      .seed = 0xFFFF'FFFF'FFFF'FFFF,
      .n = -3,
      .numbers = {{"third", 1.0 / 3}, {"tiny", 0x1p-1070}, {"k", 4}, {"huge", -HUGE_VAL}}};
  const Params back = params_from_text(to_text(params));
  CHECK(back.seed == params.seed);
  CHECK(back.n == params.n);
  CHECK(back.numbers == params.numbers);
  CHECK(back.whole("k") == 4);
}

TEST_CASE("parameters that are missing or of a wrong kind are errors", "[params]") {
  const Params params{.numbers = {{"half", 0.5}}};
  CHECK_THROWS_AS(params["a"], carlo::Error);
  CHECK_THROWS_AS(params.whole("half"), carlo::Error);
  for (const char* bad :
       {"", "seed=1", "n=1 seed=1", "seed=x n=1", "seed=-1 n=1", "seed=1 n=1.5", "seed=1 n=1 k",
        "seed=1 n=1 =2", "seed=1 n=1 k=", "seed=1 n=1 k=2x", "seed=1 n=1 k=1 k=2", "seed=1  n=1"}) {
    INFO(bad);
    CHECK_THROWS_AS(params_from_text(bad), carlo::Error);
  }
  CHECK_THROWS_AS(to_text({.numbers = {{"two words", 1}}}), carlo::Error);
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
  // The last name of a list applies to all that follow.
  CHECK(squeezed(rows_text(list, {"mean", "point"}, 0)) ==
        "4 values came back:\n mean 0.1\n point 1 2\n point 2 4\n point 3 8\n");
  CHECK(squeezed(rows_text({1, {7}}, {"hits"}, 10)) == "1 value came back:\n hits 7\n");
  const Rows pairs{2, {0.5, 1, 0.25, 2}};
  CHECK(squeezed(rows_text(pairs, {"lower", "upper"}, 0)) ==
        "2 rows of 2 values came back:\n row lower upper\n 1 0.5 1\n 2 0.25 2\n");
  CHECK(squeezed(rows_text({2, {0.5, 1, 0.25, 2, 3, 4}}, {}, 2)) ==
        "3 rows of 2 values came back; the first 2:\n row value 1 value 2\n 1 0.5 1\n 2 0.25 2\n"
        " ... 1 more: --all\n");
  CHECK(squeezed(rows_text(pairs, {}, 1)) ==
        "2 rows of 2 values came back; the first 1:\n row value 1\n 1 0.5\n"
        " ... 1 more, and 1 more in each row: --all\n");
  CHECK(squeezed(rows_text(pairs, {"lower", "upper"}, 1)) ==
        "2 rows of 2 values came back; the first 1:\n row lower upper\n 1 0.5 1\n"
        " ... 1 more: --all\n");
  CHECK(rows_text({1, {}}, {"hits"}, 10) == "no values came back\n");
  CHECK(rows_text({}, {}, 10) == "no rows came back\n");
}

TEST_CASE("names that repeat share the columns, and are never guessed", "[rows]") {
  const std::vector<std::string> corners = {"lower ...", "upper ...", "points"};
  CHECK(names_fit(corners, 9, 5));
  CHECK(names_fit(corners, 1, 7));
  CHECK_FALSE(names_fit(corners, 9, 6));
  CHECK_FALSE(names_fit(corners, 9, 2));
  CHECK_FALSE(names_fit({}, 1, 1));
  CHECK_FALSE(names_fit({}, 1, 2));
  CHECK_FALSE(names_fit({"x"}, 1, 2));
  CHECK_FALSE(names_fit({"x", "y"}, 1, 1));
  CHECK(names_fit({"x", "y"}, 2, 1));
  CHECK(rows_text({5, {0, 0.5, 1, 1, 3}}, corners, 5).find("upper 2") != std::string::npos);
  // Named values are all shown; repeated ones as far as rows are shown.
  const std::string cut = rows_text({4, {9, 1, 2, 3}}, {"count", "x ..."}, 3);
  CHECK(cut.find("x 2") != std::string::npos);
  CHECK(cut.find("x 3") == std::string::npos);
  CHECK(cut.find("1 more: --all") != std::string::npos);
}

TEST_CASE("a table that is wider than the screen goes on below, unless all is asked for",
          "[rows]") {
  const std::vector<std::string> names = {"first", "second", "third", "fourth", "fifth"};
  Rows rows{5, std::vector<double>(15, -2.2250738585072014e-308)};
  const auto widest = [](const std::string& lines) {
    std::size_t most = 0, begin = 0;
    for (std::size_t end = 0; (end = lines.find('\n', begin)) != std::string::npos; begin = end + 1)
      most = std::max(most, end - begin);
    return most;
  };
  const std::string some = rows_text(rows, names, 2), all = rows_text(rows, names, 0);
  CHECK(widest(some) <= 80);
  CHECK(some.find("fifth") != std::string::npos);
  CHECK(std::count(some.begin(), some.end(), '\n') == 1 + (3 + 1) + (3 + 1) + 3 + 1);
  CHECK(std::count(all.begin(), all.end(), '\n') == 1 + 1 + 3);
  rows.values.assign(15, 7);
  CHECK(rows_text(rows, names, 2).find("fourth  fifth\n") != std::string::npos);
}
