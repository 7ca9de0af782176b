// Tests names that several files of a lab define.

#include "grader/grade/own_names.h"

#include <catch2/catch_test_macros.hpp>

#include <map>
#include <string>

using namespace carlo::grader;

namespace {

Symbols symbols(const std::string& nm) {
  Symbols list;
  add_symbols(list, nm);
  return list;
}

const std::map<std::string, Symbols> stubs{{"a.cpp", symbols("_Z3onev T 0 5\n")},
                                           {"b.cpp", symbols("_Z3twov T 0 5\n")}};

}  // namespace

TEST_CASE("a helper of several files stays the first one's, and is the others' own", "[names]") {
  const NewNames names = own_names({{"a.cpp", symbols("_Z3onev T 0 5\n_Z4helpd T 0 5\n")},
                                    {"b.cpp", symbols("_Z3twov T 0 5\n_Z4helpd T 0 5\n")},
                                    {"c.cpp", symbols("_Z4helpd U\n")}},
                                   stubs);
  CHECK(names == NewNames{{"b.cpp", {"_Z4helpd"}}});
  CHECK(redefinitions(names.at("b.cpp"), "steps/b.cpp") == "_Z4helpd _Z4helpd.of_steps_b_cpp\n");
  CHECK(own_names_text(names).find("help(double): several files define it") == 0);
}

TEST_CASE("an exercise's function stays with the file that it belongs to", "[names]") {
  const NewNames names = own_names(
      {{"a.cpp", symbols("_Z3onev T 0 5\n_Z3twov T 0 5\n")}, {"b.cpp", symbols("_Z3twov T 0 5\n")}},
      stubs);
  CHECK(names == NewNames{{"a.cpp", {"_Z3twov"}}});
}

TEST_CASE("what headers give to several files, and odd names, are left alone", "[names]") {
  for (const char* nm : {"_Z4helpd W 0 5\n", "counter V 0 5\n", "odd=name T 0 5\n", "gone U\n"}) {
    CAPTURE(nm);
    CHECK(own_names({{"a.cpp", symbols(nm)}, {"b.cpp", symbols(nm)}}, stubs).empty());
  }
  CHECK(
      own_names({{"a.cpp", symbols("x B 0 8\n")}, {"b.cpp", symbols("y B 0 8\n")}}, stubs).empty());
}
