#include "course/viewer/packed.h"

#include <catch2/catch_test_macros.hpp>

#include <string>

using namespace carlo;

TEST_CASE("base64: RFC 4648's own examples", "[report]") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xFF\xFB\xEF") == "//vv");
}

TEST_CASE("a picture on a page is a PNG", "[report]") {
  Image image(3, 2);
  image.at(1, 1) = Rgb(2);
  // The first 8 bytes of any PNG, in base64.
  CHECK(picture_url(image, 2).starts_with("data:image/png;base64,iVBORw0KGgo"));
}
