#include "course/viewer/viewer.h"

#include "course/viewer/packed.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

// Browser tests of the viewer are in tests/pages.

namespace {

using namespace carlo;

std::string page_with(const std::vector<Viewer>& viewers) {
  Page page("A page");
  for (const Viewer& viewer : viewers)
    add_viewer(page, viewer);
  return page.html();
}

TEST_CASE("A page has the viewer's code once, however many viewers it has") {
  const Viewer viewer{"Two images", "", {{"One", Image(4, 3)}, {"Two", Image(4, 3)}}};
  const std::string html = page_with({viewer, viewer});
  CHECK(occurrences(html, "<figure class=\"viewer\">") == 2);
  CHECK(occurrences(html, "<template id=\"viewer-template\">") == 1);
  CHECK(occurrences(html, "const viewerPixels") == 1);
  CHECK(occurrences(html, ".viewer-stage {") == 1);
  CHECK(html == page_with({viewer, viewer}));
}

TEST_CASE("A page without images has nothing of the viewer") {
  CHECK(Page("A page").html().find("viewer") == std::string::npos);
}

TEST_CASE("A viewer's words are text") {
  const std::string hostile = "</script><script>alert(1)</script><!--";
  const std::string html = page_with({{hostile, hostile, {{hostile, Image(2, 2)}}}});
  CHECK(html.find("<script>alert") == std::string::npos);
  CHECK(html.find("&lt;script&gt;alert") != std::string::npos);
}

TEST_CASE("A viewer takes images of one size, and one at least") {
  CHECK_THROWS_AS(page_with({{"None", "", {}}}), Error);
  CHECK_THROWS_AS(page_with({{"Empty", "", {{"Empty", Image()}}}}), Error);
  CHECK_THROWS_AS(page_with({{"Two", "", {{"One", Image(4, 3)}, {"Two", Image(3, 4)}}}}), Error);
  CHECK_THROWS_AS(page_with({{"Error", "", {{"One", Image(4, 3), Image(4, 4)}}}}), Error);
  CHECK_THROWS_AS(
      page_with({{"Reference", "", {{"One", Image(4, 3)}}, ViewerImage{"R", Image(4, 2)}}}), Error);
}

TEST_CASE("Packed floats differ where the upper 24 bits of the floats do") {
  const auto text = [](float x) { return packed(std::vector<float>(5, x)); };
  CHECK(text(1) == text(1 + 1e-6f));
  CHECK(text(1) != text(1 + 1e-4f));
  CHECK(text(0) != text(1e-38f));
  const float infinity = std::numeric_limits<float>::infinity();
  CHECK(text(infinity) != text(std::numeric_limits<float>::quiet_NaN()));
  CHECK(text(infinity) != text(-infinity));
  CHECK(text(infinity) != text(std::numeric_limits<float>::max()));
  CHECK(text(-infinity) != text(std::numeric_limits<float>::lowest()));
  CHECK(text(-std::numeric_limits<float>::quiet_NaN()) ==
        text(std::numeric_limits<float>::quiet_NaN()));
  CHECK(packed(std::vector<float>{}).size() % 4 == 0);
  CHECK(packed(std::vector<float>{1, 2}) != packed(std::vector<float>{2, 1}));
}

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

}  // namespace
