#include "support/number.h"

#include "random/rng.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

namespace {

using carlo::number_by_strtod;
using carlo::number_of;

}  // namespace

TEST_CASE("A number is the whole text, without blanks or a plus sign") {
  CHECK(number_of<double>("-1.5e3") == -1500.0);
  CHECK(number_of<double>(".5") == 0.5);
  CHECK(number_of<int>("-7") == -7);
  for (const char* text : {"", "-", ".", "+1", " 1", "1 ", "1,5", "0x10", "1e", "--1", "e5",
                           "1e999", "1e-999", "-1e999", "1.5.2", "nanx", "1\n"}) {
    INFO('"' << text << '"');
    CHECK(!number_of<double>(text));
    CHECK(!number_by_strtod(text));
  }
  CHECK(!number_of<int>("1.5"));
  CHECK(!number_of<std::uint8_t>("256"));
}

TEST_CASE("The C library reads the numbers that from_chars() reads, to the last bit") {
  // Ties between neighbours, the smallest and the largest numbers, zeros, and numbers without
  // digits.
  for (const char* text : {"9007199254740993", "2.2250738585072011e-308", "4.9406564584124654e-324",
                           "1.7976931348623157e308", "0", "-0", "0e999", "0.1",
                           "123456789012345678901234567890", "inf", "-inf", "1E5", "5."}) {
    INFO(text);
    const auto mine = number_by_strtod(text), expected = number_of<double>(text);
    REQUIRE(mine);
    REQUIRE(expected);
    CHECK(std::bit_cast<std::uint64_t>(*mine) == std::bit_cast<std::uint64_t>(*expected));
  }
  CHECK(std::isnan(number_by_strtod("nan").value()));
  carlo::Rng rng(7, 1);
  for (int i = 0; i < 20'000; ++i) {
    const auto any = std::bit_cast<double>(rng.next_u64());
    if (!std::isfinite(any)) continue;
    const std::string text = fmt::format("{}", any);
    REQUIRE(number_by_strtod(text) == any);
  }
}
