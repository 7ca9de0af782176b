// Shapes and transforms: where points and normals go.

#include "scene_helpers.h"

#include <string>
#include <variant>

using namespace carlo;
using scene_test::close;
using scene_test::load_elements;

namespace {

/// The only shape of a scene: a `type` with `inside`.
template <class T>
T only(const std::string& type, const std::string& inside = "") {
  const Scene scene = load_elements("<shape type=\"" + type + "\">" + inside + "</shape>");
  REQUIRE(scene.shapes.size() == 1);
  REQUIRE(std::holds_alternative<T>(scene.shapes[0].geometry));
  return std::get<T>(scene.shapes[0].geometry);
}

std::string to_world(const std::string& steps) {
  return "<transform name=\"toWorld\">" + steps + "</transform>";
}

Vec3 normal(const Parallelogram& p) {
  return glm::normalize(glm::cross(p.u, p.v));
}
Vec3 middle(const Parallelogram& p) {
  return p.origin + 0.5f * (p.u + p.v);
}
float area(const Parallelogram& p) {
  return glm::length(glm::cross(p.u, p.v));
}

/// The image of the point (1, 0, 0) under a transform, as a sphere's centre.
Vec3 image_of_x(const std::string& steps) {
  return only<Sphere>("sphere",
                      "<point name=\"center\" x=\"1\" y=\"0\" z=\"0\"/>" + to_world(steps))
      .center;
}

const std::string flip = "<boolean name=\"flipNormals\" value=\"true\"/>";

}  // namespace

TEST_CASE("a rectangle is the square from -1 to 1 with normal +z", "[scene]") {
  const auto r = only<Parallelogram>("rectangle");
  CHECK(close(middle(r), Vec3(0)));
  CHECK(close(normal(r), Vec3(0, 0, 1)));
  CHECK(area(r) == Catch::Approx(4));
}

TEST_CASE("a rectangle's normal follows the inverse transpose, mirrored or not", "[scene]") {
  // A shear along z by x tilts the normal to (-1, 0, 1)/sqrt 2.
  const auto sheared = only<Parallelogram>(
      "rectangle", to_world("<matrix value=\"1 0 0 0  0 1 0 0  1 0 1 0  0 0 0 1\"/>"));
  CHECK(close(normal(sheared), glm::normalize(Vec3(-1, 0, 1))));
  CHECK(close(normal(only<Parallelogram>("rectangle", to_world("<scale x=\"-1\"/>"))),
              Vec3(0, 0, 1)));
  CHECK(close(normal(only<Parallelogram>("rectangle", to_world("<scale z=\"-1\"/>"))),
              Vec3(0, 0, -1)));
  CHECK(close(normal(only<Parallelogram>("rectangle", flip)), Vec3(0, 0, -1)));
  CHECK(close(normal(only<Parallelogram>("rectangle", flip + to_world("<scale z=\"-1\"/>"))),
              Vec3(0, 0, 1)));
}

TEST_CASE("a cube has six faces of area 4 that look outwards", "[scene]") {
  for (const char* steps :
       {"", "<scale x=\"-1\"/>", "<rotate x=\"1\" y=\"2\" z=\"3\" angle=\"50\"/>"}) {
    const Scene scene = load_elements("<shape type=\"cube\">" + to_world(steps) + "</shape>");
    REQUIRE(scene.shapes.size() == 6);
    Vec3 sum{0};
    for (const Shape& shape : scene.shapes) {
      const auto& face = std::get<Parallelogram>(shape.geometry);
      CHECK(close(normal(face), middle(face)));  // the faces are at distance 1 from the origin
      CHECK(area(face) == Catch::Approx(4));
      sum += glm::abs(normal(face));
    }
    if (std::string(steps).find("rotate") == std::string::npos) CHECK(close(sum, Vec3(2)));
  }
}

TEST_CASE("flipNormals turns a cube's faces inwards", "[scene]") {
  for (const Shape& shape : load_elements("<shape type=\"cube\">" + flip + "</shape>").shapes) {
    const auto& face = std::get<Parallelogram>(shape.geometry);
    CHECK(close(normal(face), -middle(face)));
  }
}

TEST_CASE("a sphere is moved and scaled, and may be flipped", "[scene]") {
  const auto plain = only<Sphere>("sphere");
  CHECK(close(plain.center, Vec3(0)));
  CHECK(plain.radius == 1.0f);
  CHECK_FALSE(plain.flipped);
  const auto moved =
      only<Sphere>("sphere",
                   "<point name=\"center\" x=\"1\" y=\"2\" z=\"3\"/><float name=\"radius\" "
                   "value=\"0.5\"/>" +
                       flip +
                       to_world("<scale value=\"-2\"/><rotate y=\"1\" angle=\"90\"/>"
                                "<translate x=\"10\"/>"));
  // (1, 2, 3) -> (-2, -4, -6) -> rotation about y takes z to x and x to -z -> (-6, -4, 2) -> + 10
  CHECK(close(moved.center, Vec3(4, -4, 2)));
  CHECK(moved.radius == Catch::Approx(1));
  CHECK(moved.flipped);
}

TEST_CASE("a disk keeps its normal under scale, rotation and mirroring", "[scene]") {
  const auto plain = only<Disk>("disk");
  CHECK(close(plain.normal, Vec3(0, 0, 1)));
  CHECK(plain.radius == Catch::Approx(1));
  const auto turned = only<Disk>(
      "disk", to_world("<scale value=\"3\"/><rotate x=\"1\" angle=\"90\"/><translate y=\"5\"/>"));
  CHECK(close(turned.normal, Vec3(0, -1, 0)));
  CHECK(close(turned.center, Vec3(0, 5, 0)));
  CHECK(turned.radius == Catch::Approx(3));
  CHECK(close(only<Disk>("disk", to_world("<scale x=\"-1\"/>")).normal, Vec3(0, 0, 1)));
  CHECK(close(only<Disk>("disk", to_world("<scale z=\"-1\"/>")).normal, Vec3(0, 0, -1)));
  CHECK(close(only<Disk>("disk", flip).normal, Vec3(0, 0, -1)));
}

TEST_CASE("the steps of a transform are applied in the order they stand in", "[scene]") {
  const std::string move = "<translate x=\"1\" y=\"2\"/>", turn = "<rotate z=\"1\" angle=\"90\"/>";
  CHECK(close(image_of_x(move + turn), Vec3(-2, 2, 0)));
  CHECK(close(image_of_x(turn + move), Vec3(1, 3, 0)));
}

TEST_CASE("a matrix is written row by row and acts on column vectors", "[scene]") {
  CHECK(
      close(image_of_x("<matrix value=\"0 -1 0 5  1 0 0 6  0 0 1 7  0 0 0 1\"/>"), Vec3(5, 7, 7)));
  CHECK(
      close(image_of_x("<matrix value=\"0,-1,0,5, 1,0,0,6, 0,0,1,7, 0,0,0,1\"/>"), Vec3(5, 7, 7)));
}

TEST_CASE("a rotation is counter-clockwise, in degrees, about any axis", "[scene]") {
  CHECK(close(image_of_x("<rotate y=\"2\" angle=\"90\"/>"), Vec3(0, 0, -1)));
  CHECK(close(image_of_x("<rotate x=\"1\" y=\"1\" z=\"1\" angle=\"120\"/>"), Vec3(0, 1, 0)));
  CHECK(close(image_of_x("<rotate z=\"1\" angle=\"-30\"/>"), Vec3(std::sqrt(0.75f), -0.5f, 0)));
}

TEST_CASE("numbers may have signs, exponents and white space", "[scene]") {
  CHECK(close(image_of_x("<translate x=\" +1e1 \" y=\"-.5\" z=\"2.\"/>"), Vec3(11, -0.5f, 2)));
}

TEST_CASE("small and large objects are no degenerate ones", "[scene]") {
  CHECK(area(only<Parallelogram>("rectangle", to_world("<scale value=\"1e-8\"/>"))) ==
        Catch::Approx(4e-16));
  CHECK(only<Sphere>("sphere", to_world("<scale value=\"1e15\"/>")).radius == Catch::Approx(1e15));
}

TEST_CASE("a rotation's axis is a direction, however long it is", "[scene]") {
  // Mitsuba 3.9.1 takes the axis as it is: z="2" also makes an area of 4 one of 16.
  for (const char* z : {"1", "2", "-2", "0.1", "1e-200", "1e30"}) {
    const std::string turn = "<rotate z=\"" + std::string(z) + "\" angle=\"90\"/>";
    INFO(turn);
    CHECK(close(image_of_x(turn), Vec3(0, z[0] == '-' ? -1 : 1, 0)));
    CHECK(area(only<Parallelogram>("rectangle", to_world(turn))) == Catch::Approx(4));
  }
  const std::string diagonal = "<rotate value=\"3, 3, 0\" angle=\"180\"/>";
  CHECK(close(image_of_x(diagonal), Vec3(0, 1, 0)));
}
