// Radiance pictures (.hdr): the meaning of their pixels, and the errors of broken ones.

#include "image/hdr.h"

#include "support/atomic_file.h"
#include "support/error.h"
#include "temporary_folder.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace carlo;
using Catch::Matchers::ContainsSubstring;
using common_test::TemporaryFolder;
namespace fs = std::filesystem;

/// A Radiance picture of 8 x 2 pixels: a plain row, and a run-length encoded one.
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
  bytes += {3, 1, 2, 3};  // literal bytes
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
  const Image image = read_hdr(path).image;
  REQUIRE((image.width == 8 && image.height == 2));
  // m 2^(e - 136)
  CHECK(image.at(0, 0) == Rgb(1, .5f, 0));
  CHECK(image.at(7, 0) == Rgb(135 / 128.0f, .5f, 0));
  CHECK(image.at(0, 1) == Rgb(200 / 256.0f, 1 / 256.0f, 0));
  CHECK(image.at(3, 1) == Rgb(200 / 256.0f, 4 / 256.0f, 0));
  CHECK(image.at(4, 1) == Rgb(0));
  write_file(path, radiance_picture("EXPOSURE= 2\nEXPOSURE=2\n"));
  CHECK(read_hdr(path).image.at(0, 0) == Rgb(.25f, .125f, 0));
}

/// The colour of the first pixel, (1, .5, 0) in the file, and the notes.
HdrFile with_header(const std::string& header, const std::string& behind = "") {
  const TemporaryFolder scratch;
  write_file(scratch.path() / "a.hdr", radiance_picture(header) + behind);
  return read_hdr(scratch.path() / "a.hdr");
}

TEST_CASE("A Radiance picture is divided by its EXPOSURE and its COLORCORR") {
  CHECK(with_header("COLORCORR= 2 4 8\n").image.at(0, 0) == Rgb(.5f, .125f, 0));
  CHECK(with_header("COLORCORR=2 4 8\nEXPOSURE=2\nCOLORCORR=\t.5  1 1 \n").image.at(0, 0) ==
        Rgb(.5f, .0625f, 0));
  // Lines from the pictures that this one was made of are indented.
  CHECK(with_header("pfilt -e 2\n\tEXPOSURE=2\n\tCOLORCORR=2 2 2\n").image.at(0, 0) ==
        Rgb(1, .5f, 0));
  for (const std::string wrong : {"COLORCORR=1 1\n", "COLORCORR=1 1 1 1\n", "COLORCORR=1 x 1\n",
                                  "COLORCORR=1 0 1\n", "COLORCORR=1 -1 1\n", "COLORCORR=nan 1 1\n"})
    CHECK_THROWS_WITH(with_header(wrong), ContainsSubstring("its COLORCORR"));
}

TEST_CASE("A Radiance picture's PRIMARIES are taken to those of Rec. 709") {
  const HdrFile same = with_header("PRIMARIES= .640 .330 .300 .600 .150 .060 .3127 .3290\n");
  CHECK(same.image.pixels == with_header("").image.pixels);
  CHECK(same.notes.empty());
  // Radiance's own primaries have another green and the equal-energy white.
  const HdrFile other = with_header("PRIMARIES= .640 .330 .290 .600 .150 .060 .3333 .3333\n");
  REQUIRE(other.notes.size() == 1);
  CHECK_THAT(other.notes[0], ContainsSubstring("a.hdr: its PRIMARIES, red (0.64, 0.33)"));
  CHECK(other.image.at(0, 0) != Rgb(1, .5f, 0));
  CHECK(std::abs(other.image.at(0, 0).r - 1) < .1f);
  CHECK(other.image.at(4, 1) == Rgb(0));
  CHECK(with_header("PRIMARIES=0 0 0 0 0 0 0 0\n").image.pixels == same.image.pixels);
  CHECK(with_header("PRIMARIES=0 0 0 0 0 0 0 0\n").notes.size() == 1);
  CHECK_THROWS_WITH(with_header("PRIMARIES=.3 .3 .3 .3 .3 .3 .3 .3\n"),
                    ContainsSubstring("a.hdr: its primaries span no colours"));
  CHECK_THROWS_WITH(with_header("PRIMARIES=.3 .3\n"), ContainsSubstring("must be 8 numbers"));
}

TEST_CASE("What a Radiance picture's header says and is not used is noted, or refused") {
  CHECK(with_header("SOFTWARE=x\nCAPDATE=2000:01:01 00:00:00\nGAMMA=1\nPIXASPECT=1.0\n")
            .notes.empty());
  CHECK(with_header("VIEW= -vtv -vh 45\n").notes ==
        std::vector<std::string>{"a.hdr: its VIEW is not used"});
  CHECK(with_header("PIXASPECT=.5\n").notes ==
        std::vector<std::string>{"a.hdr: its PIXASPECT is not used"});
  CHECK_THROWS_WITH(with_header("GAMMA=2.2\n"), ContainsSubstring("its GAMMA is not 1"));
}

TEST_CASE(
    "A Radiance picture may have lines that end in CR LF, a mark before it and bytes behind") {
  const TemporaryFolder scratch;
  const fs::path path = scratch.path() / "a.hdr";
  std::string bytes = radiance_picture("EXPOSURE=2\nPRIMARIES=0 0 0 0 0 0 0 0\n");
  const Image expected = with_header("EXPOSURE=2\n").image;
  const std::size_t header = bytes.find("+X 8\n") + 5;
  for (std::size_t at = 0; (at = bytes.find('\n', at)) < header + 20; at += 2) {
    if (bytes.substr(0, at).find("+X 8\r\n") != std::string::npos) break;
    bytes.replace(at, 1, "\r\n");
  }
  write_file(path, "\xef\xbb\xbf" + bytes);
  CHECK(read_hdr(path).image.pixels == expected.pixels);
  for (const std::string& behind : {std::string("\n"), std::string("\r\n"), std::string(3, '\0')}) {
    const HdrFile file = with_header("EXPOSURE=2\n", behind);
    CHECK(file.image.pixels == expected.pixels);
    REQUIRE(file.notes.size() == 1);
    CHECK_THAT(file.notes[0], ContainsSubstring("bytes follow the last pixel and are not used"));
  }
}

TEST_CASE("A Radiance picture whose rows go another way is refused") {
  const TemporaryFolder scratch;
  const fs::path path = scratch.path() / "a.hdr";
  for (const std::string size : {"+Y 2 +X 8", "-Y 2 -X 8", "+Y 2 -X 8", "+X 8 -Y 2", "-X 8 +Y 2"}) {
    std::string bytes = radiance_picture();
    bytes.replace(bytes.find("-Y 2 +X 8"), 9, size);
    write_file(path, bytes);
    CHECK_THROWS_WITH(read_hdr(path), ContainsSubstring("its"));
  }
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
  CHECK_THAT(error_of(whole + "a row of pix"), ContainsSubstring("12 bytes follow the last pixel"));
  CHECK_THAT(error_of(radiance_picture("EXPOSURE=0\n")), ContainsSubstring("its EXPOSURE"));
  CHECK_THAT(error_of("#?RGBE\n\n-Y 99999 +X 99999\n"), ContainsSubstring("99999 x 99999 pixels"));
  CHECK_THAT(error_of("#?RGBE\n\n-Y 9 +X -9\n"), ContainsSubstring("its width"));
  CHECK_THAT(error_of("#?RGBE\n\n-Y 1 +X 1\n\1\1\1\2"), ContainsSubstring("in the old way"));
  std::string long_run = whole;
  long_run[whole.size() - 2] = static_cast<char>(128 + 5);
  CHECK_THAT(error_of(long_run), ContainsSubstring("does not fit into its row"));
  CHECK_THROWS_AS(read_hdr(scratch.path() / "nowhere.hdr"), Error);
}

TEST_CASE("A Radiance picture's mantissas are 256ths, and nothing is added to them") {
  // three.js 0.170.0 divides by 255. Radiance itself adds 1/2 to each mantissa, since it cuts off
  // when it writes; OpenImageIO, OpenCV and Mitsuba do not, and black would be no longer black.
  const TemporaryFolder scratch;
  const fs::path path = scratch.path() / "a.hdr";
  const std::vector<int> exponents = {1, 100, 128, 129, 136, 200, 255};
  for (const int exponent : exponents) {
    const std::string bytes = {'\x80', '\1', '\0', static_cast<char>(exponent)};
    write_file(path, "#?RADIANCE\n\n-Y 1 +X 1\n" + bytes);
    const float unit = std::ldexp(1.f, exponent - 136);
    CHECK(read_hdr(path).image.at(0, 0) == Rgb(128 * unit, unit, 0));
  }
}

TEST_CASE("What is wrong with a Radiance picture's header is told with its value") {
  const auto check_tells = [](const std::string& line, const std::string& message) {
    CHECK_THROWS_WITH(with_header(line), ContainsSubstring(message));
  };
  check_tells("EXPOSURE=-2\n", "its EXPOSURE must be a number > 0, got \"-2\"");
  check_tells("COLORCORR=1 0 1\n", "its COLORCORR must be three numbers > 0, got \"1 0 1\"");
  check_tells("COLORCORR=1 1\n", "its COLORCORR must be 3 numbers, got \"1 1\"");
  check_tells("PRIMARIES=.3 .3\n", "its PRIMARIES must be 8 numbers, got \".3 .3\"");
  check_tells("GAMMA=2.2\n", "its GAMMA is not 1, but \"2.2\": expected linear values");
  // three.js 0.170.0 takes CIE XYZ for RGB.
  check_tells("FORMAT=32-bit_rle_xyze\n",
              "its FORMAT is not 32-bit_rle_rgbe, but \"32-bit_rle_xyze\"");
  const TemporaryFolder scratch;
  const fs::path path = scratch.path() / "a.hdr";
  write_file(path, "#?RADIANCE\n\n+Y 1 +X 1\n1234");
  CHECK_THROWS_WITH(read_hdr(path), ContainsSubstring("but as \"+Y 1 +X 1\""));
}

}  // namespace
