// Radiance pictures (.hdr): what their pixels stand for, and what is wrong with broken ones.

#include "image/hdr.h"

#include "cli/atomic_file.h"
#include "cli/error.h"
#include "temporary_folder.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <cstddef>
#include <filesystem>
#include <string>

namespace {

using namespace carlo;
using Catch::Matchers::ContainsSubstring;
using common_test::TemporaryFolder;
namespace fs = std::filesystem;

/// A Radiance picture of 8 x 2 pixels: a plain row, and one in runs.
std::string radiance_picture(const std::string& header = "") {
  std::string bytes =
      "#?RADIANCE\n# made here\nFORMAT=32-bit_rle_rgbe\n" + header + "\n-Y 2 +X 8\n";
  for (int x = 0; x < 8; ++x)
    bytes += {static_cast<char>(128 + x), 64, 0, static_cast<char>(129)};
  bytes += {2, 2, 0, 8};
  const auto run = [&bytes](int count, int value) {
    bytes += {static_cast<char>(128 + count), static_cast<char>(value)};
  };
  run(8, 200);
  bytes += {3, 1, 2, 3};  // as they are
  run(5, 4);
  run(8, 0);
  run(4, 128);
  run(4, 0);
  return bytes;
}

TEST_CASE("A Radiance picture has the values that its pixels stand for") {
  const TemporaryFolder scratch;
  const fs::path path = scratch.path() / "a.hdr";
  write_file(path, radiance_picture());
  const Image image = read_hdr(path);
  REQUIRE((image.width == 8 && image.height == 2));
  // m 2^(e - 136)
  CHECK(image.at(0, 0) == Rgb(1, .5f, 0));
  CHECK(image.at(7, 0) == Rgb(135 / 128.0f, .5f, 0));
  CHECK(image.at(0, 1) == Rgb(200 / 256.0f, 1 / 256.0f, 0));
  CHECK(image.at(3, 1) == Rgb(200 / 256.0f, 4 / 256.0f, 0));
  CHECK(image.at(4, 1) == Rgb(0));
  write_file(path, radiance_picture("EXPOSURE= 2\nEXPOSURE=2\n"));
  CHECK(read_hdr(path).at(0, 0) == Rgb(.25f, .125f, 0));
}

TEST_CASE("A Radiance picture that is broken anywhere is an error") {
  const TemporaryFolder scratch;
  const fs::path path = scratch.path() / "a.hdr";
  const auto error_of = [&](const std::string& bytes) -> std::string {
    write_file(path, bytes);
    try {
      read_hdr(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  const std::string whole = radiance_picture();
  for (std::size_t length = 0; length < whole.size(); ++length)
    CHECK(error_of(whole.substr(0, length)) != "none");
  CHECK_THAT(error_of(whole + "x"), ContainsSubstring("1 bytes follow the last pixel"));
  CHECK_THAT(error_of(radiance_picture("EXPOSURE=0\n")), ContainsSubstring("its EXPOSURE"));
  CHECK_THAT(error_of("#?RGBE\n\n-Y 99999 +X 99999\n"), ContainsSubstring("99999 x 99999 pixels"));
  CHECK_THAT(error_of("#?RGBE\n\n-Y 9 +X -9\n"), ContainsSubstring("its width"));
  CHECK_THAT(error_of("#?RGBE\n\n-Y 1 +X 1\n\1\1\1\2"), ContainsSubstring("in the old way"));
  std::string long_run = whole;
  long_run[whole.size() - 2] = static_cast<char>(128 + 5);
  CHECK_THAT(error_of(long_run), ContainsSubstring("does not fit into its row"));
  CHECK_THROWS_AS(read_hdr(scratch.path() / "nowhere.hdr"), Error);
}

}  // namespace
