// Tests what an exercise's object may define and call.

#include "grader/grade/foreign_symbols.h"

#include "grader/grade/replaceable.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <string>

using namespace carlo::grader;

namespace {

std::string why(const std::string& exercise, const std::string& ours) {
  Symbols theirs, known;
  add_symbols(theirs, exercise);
  add_symbols(known, ours);
  return foreign_symbols(theirs, known, "lab01");
}

/// nm's output for our objects: main, a use of write, the contract, an inline function.
const std::string ours =
    "libworker.a[main.cpp.o]:\nmain T 0 10\nwrite U\n_Znwm T 0 8\n"
    "_ZN5lab017averageE U\n_ZNSt6vectorIdE4growEv W 0 10\n";

}  // namespace

TEST_CASE("an exercise's own functions and those of headers are no offence", "[symbols]") {
  CHECK(why("_ZN5lab017averageE T 0 5\n_ZNK5lab017Moments4meanEv T 0 5\n", ours).empty());
  CHECK(why("_Z6helperd T 0 5\ncounter B 0 8\n", ours).empty());
  CHECK(why("_ZNSt6vectorIdE4growEv W 0 12\n_Znwm U\nwrite U\nmemset U\n", ours).empty());
}

TEST_CASE("an exercise's functions are found by name, whatever their parameters", "[symbols]") {
  CHECK(is_symbol_of("_ZN5lab017averageERKSt8functionIFddEEl", "lab01", "average"));
  CHECK(is_symbol_of("_ZNK5lab017Moments8varianceEv", "lab01", "Moments::variance"));
  CHECK(is_symbol_of("_ZN5lab055TableC1ESt6vectorIdSaIdEE", "lab05", "Table::Table"));
  CHECK(is_symbol_of("_ZN5lab055TableC2ESt6vectorIdSaIdEE", "lab05", "Table::Table"));
  CHECK(is_symbol_of("_ZN5lab014nameB5cxx11Ei", "lab01", "name"));
  for (const char* other :
       {"_ZN5lab017averageIdEEvT_", "_ZN5lab018averagesEv", "_ZN5lab027averageEv", "_Z7averagev",
        "_ZN5lab017Moments7averageEv", "average", ""}) {
    INFO(other);
    CHECK_FALSE(is_symbol_of(other, "lab01", "average"));
  }
  CHECK_FALSE(is_symbol_of("_ZN5lab055Table3CutEv", "lab05", "Table::Table"));
}

TEST_CASE("what takes the place of ours is refused, and named", "[symbols]") {
  CHECK(why("main T 0 5\n", ours).find("it defines main") == 0);
  CHECK(why("write T 0 5\n", ours).find("it defines write") == 0);
  CHECK(why("write W 0 5\n", ours).find("it defines write") == 0);
  CHECK(why("write P 0 5\n", ours).find("it defines write") == 0);  // in a section ".pdata"
  CHECK(why("write@@GLIBC_2.2.5 T 0 5\n", ours).find("it defines write") == 0);
  CHECK(why("write@GLIBC_2.2.5 U\n", ours).empty());
  CHECK(why("_Znwm T 0 5\n", ours).find("it defines operator new(unsigned long)") == 0);
  CHECK(why("_ZNSt6vectorIdE4growEv T 0 12\n", ours).find("it defines std::vector") == 0);
}

TEST_CASE("what is given stays as it is given, by name and by copy", "[symbols]") {
  const std::string given =
      "_ZN5lab015World3hitEv T 0 9\n_ZN5lab014wordEm W 0 9\n"
      "_ZN5carlo5scaleEd T 0 9\n_ZN5lab017averageE U\n";
  CHECK(why("_ZN5lab015World3hitEv T 0 5\n", given).find("it defines lab01::World::hit") == 0);
  CHECK(why("_ZN5lab015World3hitEv W 0 5\n", given).find("it defines lab01::World::hit") == 0);
  CHECK(why("_ZN5lab014wordEm T 0 5\n", given).find("it defines lab01::word") == 0);
  CHECK(why("_ZN5carlo5scaleEd W 0 5\n", given).find("it defines carlo::scale") == 0);
  CHECK(why("_ZN5lab014wordEm W 0 9\n_ZN5lab017averageE T 0 5\n_ZN5carlo5scaleEd U\n", given)
            .empty());
}

TEST_CASE("the grader's own functions are not for exercises", "[symbols]") {
  CHECK(why("_ZN5carlo6grader6probesB5cxx11Ev U\n", ours).find("part of the grader") !=
        std::string::npos);
  CHECK(why("_ZN11lab01_tests7hits_ofEl U\n", ours).find("part of the grader") !=
        std::string::npos);
}

TEST_CASE("names that double at each step are not read to their end", "[symbols]") {
  std::string name = "_Z1fN5carlo6grader1AE";
  CHECK(readable(name) == "f(carlo::grader::A)");
  // Each is B<x, x> of the previous one: the odd references.
  for (int step = 0; step < 17; ++step) {
    const char last = "13579BDFHJLNPRTVX"[step];
    name += fmt::format("1BIS{0}_S{0}_E", last);
  }
  CHECK(readable(name).size() <= 203);
  CHECK(why(name + " U\n", ours).find("part of the grader") != std::string::npos);
  // Deep nesting without back references, too.
  CHECK(readable("_Z1f" + std::string(100'000, 'P') + "i").size() <= 203);
  CHECK(readable("_Z1f" + std::string(900, 'P') + "i").size() <= 203);
}
