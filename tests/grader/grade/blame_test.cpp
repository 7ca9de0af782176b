#include "grader/grade/blame.h"

#include <catch2/catch_test_macros.hpp>

using carlo::grader::tells_of_the_machine;

namespace {

constexpr std::size_t limit = std::size_t{1536} << 20, little = std::size_t{100} << 20;

}  // namespace

TEST_CASE("what the machine lacks is told from what a file holds", "[grade]") {
  for (const char* said :
       {"cc1plus: fatal error: error writing to /tmp/ccX.s: No space left on device",
        "{standard input}: Fatal error: can't write 12 bytes to section .text of exercise.o: "
        "'No space left on device'",
        "c++: fatal error: cannot execute 'cc1plus': vfork: Resource temporarily unavailable",
        "c++: fatal error: Killed signal terminated program cc1plus",
        "c++: internal compiler error: Killed (program cc1plus)",
        "collect2: fatal error: ld terminated with signal 9 [Killed]",
        "cc1plus: out of memory allocating 65536 bytes after a total of 9000000 bytes",
        "virtual memory exhausted: Cannot allocate memory",
        "integration.cpp:3:1: warning: unused\n/usr/bin/ld: final link failed: No space left on "
        "device"}) {
    INFO(said);
    CHECK(tells_of_the_machine(said, little, limit));
  }
  for (const char* said :
       {"integration.cpp:3:2: error: #error No space left on device",
        "    3 | throw std::runtime_error(\"Cannot allocate memory\");", "",
        "integration.cpp:7: error: out of memory", "ld: integration.o: undefined reference to `f'",
        "c++: fatal error: CPU time limit exceeded signal terminated program cc1plus",
        "c++: fatal error: File size limit exceeded signal terminated program as",
        "cc1plus: out of memory allocating 8589934592 bytes after a total of 9000000 bytes"}) {
    INFO(said);
    CHECK_FALSE(tells_of_the_machine(said, little, limit));
  }
}

TEST_CASE("who takes all memory that there may be is not a victim of the machine", "[grade]") {
  const char* killed = "c++: fatal error: Killed signal terminated program cc1plus";
  CHECK(tells_of_the_machine(killed, limit / 4, limit));
  CHECK_FALSE(tells_of_the_machine(killed, limit * 3 / 4, limit));
  CHECK(tells_of_the_machine("as: No space left on device", limit, limit));
}
