// Materials, lights, camera, film, sampler, parameters, includes, needs and our own scenes.

#include "course/cli/source_folder.h"
#include "scene/needs.h"
#include "scene_helpers.h"

#include <cmath>
#include <string>
#include <variant>

using namespace carlo;
using scene_test::close;
using scene_test::load_elements;
using scene_test::load_text;
using scene_test::TemporaryFolder;
using scene_test::write_bytes;

namespace {

const std::filesystem::path source_dir = source_folder();

/// The material of a sphere with that bsdf.
Material material(const std::string& bsdf) {
  const Scene scene = load_elements("<shape type=\"sphere\">" + bsdf + "</shape>");
  return scene.materials.at(scene.shapes.at(0).material);
}

template <class T>
T model(const std::string& bsdf) {
  const Material m = material(bsdf);
  REQUIRE(std::holds_alternative<T>(m.model));
  return std::get<T>(m.model);
}

Scene load_sensor(const std::string& inside) {
  return load_text("<scene version=\"0.6.0\"><sensor type=\"perspective\">" + inside +
                   "</sensor></scene>");
}

std::string film(int width, int height) {
  return "<film type=\"hdrfilm\"><integer name=\"width\" value=\"" + std::to_string(width) +
         "\"/><integer name=\"height\" value=\"" + std::to_string(height) + "\"/></film>";
}

const std::string fov90 = "<float name=\"fov\" value=\"90\"/>";

}  // namespace

TEST_CASE("what floats cannot tell from a turned plane is told of", "[scene]") {
  // A card of half side `card` above a floor of half side `floor`, both rotated about an axis.
  const auto notes = [](double floor, double card, double gap, double turn) {
    const auto square = [&](double half, double height) {
      return "<shape type=\"rectangle\"><transform name=\"toWorld\"><scale value=\"" +
             std::to_string(half) + "\"/><translate z=\"" + std::to_string(height) +
             "\"/><rotate x=\"1\" y=\".3\" angle=\"" + std::to_string(turn) +
             "\"/></transform></shape>";
    };
    return load_text("<scene version=\"0.6.0\"><sensor type=\"perspective\">" + fov90 +
                     "</sensor><emitter type=\"constant\"><rgb name=\"radiance\" "
                     "value=\"1\"/></emitter>" +
                     square(floor, 0) + square(card, gap) + "</scene>")
        .notes;
  };
  CHECK(notes(1, 1, 1e-3, 40).empty());
  CHECK(notes(1e3, 1, 1, 40).empty());
  CHECK(notes(1e5, 1, 1e-3, 0).empty());
  CHECK(notes(1e3, 1, 0, 40).empty());
  CHECK(notes(1, 1, 2e-5, 40).size() == 1);
  CHECK(notes(1e5, 1, 1e-3, 40).size() == 1);
  REQUIRE(notes(1e5, 1, 0, 40).size() == 1);
  CHECK(notes(1e5, 1, 0, 40)[0].find("floats place a parallelogram") != std::string::npos);
}

TEST_CASE("a scene far from the origin is moved there with all that it has", "[scene]") {
  // Coordinates with more digits than a float, whose step is .03 at 1e6.
  const std::string there = "<translate x=\"1e6\" y=\"-2e6\" z=\"3e6\"/>";
  const auto text = [](const std::string& move) {
    return "<scene version=\"0.6.0\"><shape type=\"sphere\"><point name=\"center\" x=\".125\" "
           "y=\"0\" z=\"0\"/><transform name=\"toWorld\">" +
           move + "</transform></shape><shape type=\"rectangle\"><transform name=\"toWorld\">" +
           "<translate x=\".25\"/>" + move +
           "</transform></shape><emitter type=\"point\"><transform name=\"toWorld\"><translate "
           "y=\"2\"/>" +
           move + "</transform><rgb name=\"intensity\" value=\"1\"/></emitter>" +
           "<sensor type=\"perspective\">" + fov90 +
           "<transform name=\"toWorld\"><translate z=\"-4\"/>" + move +
           "</transform></sensor></scene>";
  };
  const Scene near = load_text(text("")), far = load_text(text(there));
  CHECK(near.notes.empty());
  REQUIRE(far.notes.size() == 1);
  CHECK(far.notes[0].find("far from the origin") != std::string::npos);
  const auto& ball = std::get<Sphere>(far.shapes[0].geometry);
  const Vec3 moved = ball.center - std::get<Sphere>(near.shapes[0].geometry).center;
  CHECK(glm::length(ball.center) < 8);
  const auto same = [&](Vec3 a, Vec3 b) { return glm::length(b - a - moved) <= 1e-6f; };
  CHECK(same(std::get<Parallelogram>(near.shapes[1].geometry).origin,
             std::get<Parallelogram>(far.shapes[1].geometry).origin));
  CHECK(same(near.lights.points[0].position, far.lights.points[0].position));
  CHECK(same(near.camera.origin, far.camera.origin));
}

TEST_CASE("a diffuse material has a reflectance, 0.5 if none is given", "[scene]") {
  CHECK(model<Diffuse>("<bsdf type=\"diffuse\"/>").reflectance == Rgb(0.5f));
  const auto red = model<Diffuse>(
      "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\".7 .1, .2\"/></bsdf>");
  CHECK(red.reflectance == Rgb(0.7f, 0.1f, 0.2f));
  CHECK(
      model<Diffuse>("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"0.3\"/></bsdf>")
          .reflectance == Rgb(0.3f));
  CHECK(model<Diffuse>("").reflectance == Rgb(0.5f));
}

TEST_CASE("a Phong material has two reflectances and an exponent", "[scene]") {
  const auto plain = model<Phong>("<bsdf type=\"phong\"/>");
  CHECK(plain.kd == Rgb(0.5f));
  CHECK(plain.ks == Rgb(0.2f));
  CHECK(plain.exponent == 30.0f);
  const auto full = model<Phong>(
      "<bsdf type=\"phong\"><rgb name=\"diffuseReflectance\" value=\"0.3, 0.2, 0\"/>"
      "<rgb name=\"specularReflectance\" value=\"0.7, 0.8, 1\"/>"
      "<float name=\"exponent\" value=\"0\"/></bsdf>");
  CHECK(full.ks == Rgb(0.7f, 0.8f, 1.0f));
  CHECK(full.exponent == 0.0f);
}

TEST_CASE("a conductor without material is a mirror, a dielectric is glass in air", "[scene]") {
  CHECK(model<Mirror>("<bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/></bsdf>")
            .reflectance == Rgb(1));
  const auto glass = model<Dielectric>("<bsdf type=\"dielectric\"/>");
  CHECK(glass.int_ior == 1.5046f);
  CHECK(glass.ext_ior == 1.000277f);
  const auto bubble = model<Dielectric>(
      "<bsdf type=\"dielectric\"><string name=\"intIOR\" value=\"vacuum\"/>"
      "<float name=\"extIOR\" value=\"1.25\"/></bsdf>");
  CHECK(bubble.int_ior == 1.0f);
  CHECK(bubble.ext_ior == 1.25f);
}

TEST_CASE("a material is one-sided unless it stands inside twosided", "[scene]") {
  CHECK_FALSE(material("<bsdf type=\"phong\"/>").two_sided);
  const Material both = material("<bsdf type=\"twosided\"><bsdf type=\"phong\"/></bsdf>");
  CHECK(both.two_sided);
  CHECK(std::holds_alternative<Phong>(both.model));
}

TEST_CASE("references share one material; unused ones are noted", "[scene]") {
  const Scene scene = load_elements(
      "<bsdf type=\"phong\" id=\"a\"/><bsdf type=\"diffuse\" id=\"b\"/>"
      "<bsdf type=\"twosided\" id=\"c\"><ref id=\"a\"/></bsdf>"
      "<shape type=\"sphere\"><ref id=\"c\"/></shape><shape type=\"disk\"><ref id=\"c\"/></shape>"
      "<shape type=\"cube\"><bsdf type=\"diffuse\" id=\"d\"/></shape>"
      "<shape type=\"disk\"><ref id=\"d\"/></shape>");
  CHECK(scene.materials.size() == 2);
  CHECK(scene.shapes.at(0).material == scene.shapes.at(1).material);
  CHECK(scene.shapes.at(2).material == scene.shapes.at(8).material);
  REQUIRE_FALSE(scene.notes.empty());
  CHECK(scene.notes[0] == "no shape uses the bsdf \"b\"");
}

TEST_CASE("an area light emits its radiance and is black unless it has a material", "[scene]") {
  const Scene scene = load_elements(
      "<shape type=\"disk\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"17, 12, 4\"/>"
      "</emitter></shape>");
  CHECK(scene.shapes.at(0).radiance == Rgb(17, 12, 4));
  CHECK(scene.shapes.at(0).emits());
  CHECK(std::get<Diffuse>(scene.materials.at(scene.shapes[0].material).model).reflectance ==
        Rgb(0));
  CHECK(scene.notes.empty());
}

TEST_CASE("point lights and the environment are lights without a shape", "[scene]") {
  const Scene scene = load_elements(
      "<emitter type=\"point\"><point name=\"position\" x=\"1\" y=\"2\" z=\"3\"/>"
      "<rgb name=\"intensity\" value=\"5\"/></emitter>"
      "<emitter type=\"point\"><transform name=\"toWorld\"><translate y=\"4\"/></transform>"
      "<spectrum name=\"intensity\" value=\"6\"/></emitter>"
      "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.1, 0.2, 0.3\"/></emitter>");
  REQUIRE(scene.lights.points.size() == 2);
  CHECK(close(scene.lights.points[0].position, Vec3(1, 2, 3)));
  CHECK(scene.lights.points[0].intensity == Rgb(5));
  CHECK(close(scene.lights.points[1].position, Vec3(0, 4, 0)));
  CHECK(scene.lights.environment == Rgb(0.1f, 0.2f, 0.3f));
}

TEST_CASE("the camera looks along +z with +x to the left of the image", "[scene]") {
  const Camera camera = load_sensor(fov90 + film(100, 50)).camera;
  CHECK(close(camera.ray({0.5f, 0.5f}).d, Vec3(0, 0, 1)));
  CHECK(close(camera.ray({0, 0.5f}).d, glm::normalize(Vec3(1, 0, 1))));
  CHECK(close(camera.ray({1, 0.5f}).d, glm::normalize(Vec3(-1, 0, 1))));
  // fov spans the width by default; the film is half as high.
  CHECK(close(camera.ray({0.5f, 0}).d, glm::normalize(Vec3(0, 0.5f, 1))));
  CHECK(close(camera.ray({0.5f, 1}).d, glm::normalize(Vec3(0, -0.5f, 1))));
}

TEST_CASE("fovAxis chooses the side that fov spans", "[scene]") {
  const auto tangents = [](const std::string& axis, int width, int height) {
    const Camera c = load_sensor(fov90 + "<string name=\"fovAxis\" value=\"" + axis + "\"/>" +
                                 film(width, height))
                         .camera;
    return Vec2(c.tan_half_x, c.tan_half_y);
  };
  const auto same = [](Vec2 a, Vec2 b) { return glm::length(a - b) <= 1e-6f; };
  CHECK(same(tangents("x", 100, 50), {1, 0.5f}));
  CHECK(same(tangents("y", 100, 50), {2, 1}));
  CHECK(same(tangents("smaller", 100, 50), {2, 1}));
  CHECK(same(tangents("larger", 100, 50), {1, 0.5f}));
  CHECK(same(tangents("smaller", 50, 100), {1, 2}));
  CHECK(same(tangents("larger", 50, 100), {0.5f, 1}));
}

TEST_CASE("lookat points the camera at its target, upright", "[scene]") {
  const Camera c = load_sensor(fov90 +
                               "<transform name=\"toWorld\"><lookat origin=\"0, 1, 6.8\" "
                               "target=\"0, 1, 0\" up=\"0 2 1\"/></transform>")
                       .camera;
  CHECK(close(c.origin, Vec3(0, 1, 6.8f)));
  CHECK(close(c.forward, Vec3(0, 0, -1)));
  CHECK(close(c.up, Vec3(0, 1, 0)));
  CHECK(close(c.right, Vec3(1, 0, 0)));
}

TEST_CASE("a mirrored camera gives the mirrored image", "[scene]") {
  const Camera c =
      load_sensor(fov90 + "<transform name=\"toWorld\"><scale x=\"-1\"/></transform>").camera;
  CHECK(close(c.right, Vec3(1, 0, 0)));
  CHECK(close(c.forward, Vec3(0, 0, 1)));
}

TEST_CASE("film, sampler and integrator are read, with the documented defaults", "[scene]") {
  const Scene plain = load_sensor(fov90);
  CHECK(plain.width == 768);
  CHECK(plain.height == 576);
  CHECK(plain.spp == 64);
  CHECK(plain.sampler == SamplerKind::sobol);
  CHECK(plain.max_depth == 0);
  const auto with = [](const std::string& sampler, const std::string& depth) {
    return load_text(
        "<scene version=\"0.5.0\"><integrator type=\"path\"><integer "
        "name=\"maxDepth\" value=\"" +
        depth + "\"/></integrator><sensor type=\"perspective\">" + fov90 + film(7680, 4320) +
        "<sampler type=\"" + sampler +
        "\"><integer name=\"sampleCount\" value=\"9\"/></sampler></sensor></scene>");
  };
  const Scene full = with("stratified", "65");
  CHECK(full.width == 7680);
  CHECK(full.height == 4320);
  CHECK(full.spp == 9);
  CHECK(full.sampler == SamplerKind::stratified);
  CHECK(full.max_depth == 65);
  CHECK(with("independent", "-1").sampler == SamplerKind::independent);
  CHECK(with("independent", "-1").max_depth == 0);
}

TEST_CASE("parameters stand in for parts of values, and the caller may override them", "[scene]") {
  const std::string text =
      "<scene version=\"0.6.0\"><default name=\"spp\" value=\"8\"/>"
      "<default name=\"size\" value=\"$spp\"/><sensor type=\"perspective\">" +
      fov90 +
      "<sampler type=\"sobol\"><integer name=\"sampleCount\" value=\"1$spp\"/></sampler>"
      "<film type=\"hdrfilm\"><integer name=\"width\" value=\"$size\"/></film></sensor></scene>";
  CHECK(load_text(text).spp == 18);
  CHECK(load_text(text).width == 8);
  CHECK(load_text(text, {{"spp", "6"}}).spp == 16);
  CHECK(load_text(text, {{"spp", "6"}}).width == 6);
  CHECK(load_text(text, {{"size", "3"}}).width == 3);
}

TEST_CASE("an included file shares ids and parameters and finds files beside it", "[scene]") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "parts");
  write_bytes(folder.path() / "scene.xml",
              "<scene version=\"0.6.0\"><default name=\"r\" value=\"3\"/><include "
              "filename=\"parts/part.xml\"/><shape type=\"sphere\"><ref id=\"white\"/><float "
              "name=\"radius\" value=\"$r\"/></shape></scene>");
  write_bytes(folder.path() / "parts/part.xml",
              "<scene version=\"0.6.0\"><default name=\"r\" value=\"9\"/><sensor "
              "type=\"perspective\">" +
                  fov90 +
                  "</sensor><bsdf type=\"phong\" id=\"white\"/><shape type=\"obj\"><string "
                  "name=\"filename\" value=\"mesh.obj\"/></shape></scene>");
  write_bytes(folder.path() / "parts/mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene = load_scene(folder.path() / "scene.xml");
  REQUIRE(scene.shapes.size() == 2);
  CHECK(std::get<Sphere>(scene.shapes[1].geometry).radius == 3.0f);
  CHECK(std::holds_alternative<Phong>(scene.materials.at(scene.shapes[1].material).model));
}

TEST_CASE("what an included file names may stand beside the scene that includes it", "[scene]") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "parts");
  write_bytes(folder.path() / "scene.xml",
              "<scene version=\"0.6.0\"><include filename=\"parts/part.xml\"/></scene>");
  write_bytes(folder.path() / "parts/part.xml",
              "<scene version=\"0.6.0\"><include filename=\"parts/other.xml\"/><sensor "
              "type=\"perspective\">" +
                  fov90 + "</sensor></scene>");
  write_bytes(folder.path() / "parts/other.xml",
              "<scene version=\"0.6.0\"><shape type=\"obj\"><string name=\"filename\" "
              "value=\"mesh.obj\"/></shape></scene>");
  write_bytes(folder.path() / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(load_scene(folder.path() / "scene.xml").shapes.size() == 1);
}

TEST_CASE("needs count what stands in the scene, and say it in a line", "[scene]") {
  const Scene scene = load_elements(
      "<bsdf type=\"phong\" id=\"unused\"/>"
      "<shape type=\"cube\"><bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf></shape>"
      "<shape type=\"sphere\"><bsdf type=\"dielectric\"/></shape>"
      "<shape type=\"disk\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter>"
      "</shape><emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>");
  Needs expected;
  expected.parallelograms = 6;
  expected.spheres = expected.disks = expected.disk_lights = 1;
  expected.diffuse = expected.dielectric = expected.one_sided = expected.two_sided = true;
  expected.environment = true;
  CHECK(needs(scene) == expected);
  CHECK(needs(scene).primitives() == 8);
  CHECK(needs(scene).area_lights() == 1);
  CHECK(describe(needs(scene)) ==
        "6 parallelograms, 1 sphere, 1 disk; diffuse, dielectric, one-sided, two-sided; "
        "1 disk light, constant environment");
}

TEST_CASE("an sdf is read into steps in postfix order", "[scene]") {
  const Scene scene = load_elements(
      "<shape type=\"sdf\"><string name=\"operation\" value=\"difference\"/>"
      "<float name=\"smoothing\" value=\"0.5\"/><shape type=\"roundedBox\"/>"
      "<shape type=\"sdf\"><shape type=\"torus\"/><shape type=\"sphere\"/>"
      "<transform name=\"toWorld\"><scale value=\"3\"/></transform></shape>"
      "<transform name=\"toWorld\"><scale value=\"2\"/><translate x=\"1\"/></transform></shape>");
  Needs expected;
  expected.sdfs = 1;
  expected.diffuse = expected.one_sided = true;
  CHECK(needs(scene) == expected);
  CHECK(needs(scene).primitives() == 1);
  CHECK(describe(needs(scene)) == "1 sdf; diffuse, one-sided; no lights");
  const auto& sdf = std::get<Sdf>(scene.shapes.at(0).geometry);
  CHECK(sdf.place.scale == Catch::Approx(2));
  CHECK(sdf.place.origin.x == 1);
  REQUIRE(sdf.steps.size() == 5);
  CHECK(std::get<sdf::Solid>(sdf.steps[1]).place.scale == Catch::Approx(3));
  CHECK(std::holds_alternative<sdf::Torus>(std::get<sdf::Solid>(sdf.steps[1]).form));
  CHECK(std::get<sdf::Combine>(sdf.steps[3]).operation == sdf::Operation::unite);
  CHECK(std::get<sdf::Combine>(sdf.steps[4]).operation == sdf::Operation::subtract);
  CHECK(std::get<sdf::Combine>(sdf.steps[4]).smoothing == 0.5);
  // Half way along x: outside the ball of radius 3, out of reach of any smoothed edge.
  CHECK(sdf::distance(sdf, {0.9, 0, 0}) == Catch::Approx(2.1));
}

TEST_CASE("the Cornell boxes we bring are closed rooms lit from the ceiling", "[scene]") {
  for (const char* name : {"cornell_lambert.xml", "cornell_phong.xml"}) {
    const Scene scene = load_scene(source_dir / "common/scenes" / name);
    INFO(name);
    CHECK(scene.notes.empty());
    const Needs n = needs(scene);
    CHECK(n.parallelograms == 18);
    CHECK(n.parallelogram_lights == 1);
    CHECK(n.phong == (std::string(name) == "cornell_phong.xml"));
    // The published camera: from (278, 273, -800) along +z, the red wall (large x) on the left.
    CHECK(close(scene.camera.origin, Vec3(278, 273, -800)));
    CHECK(close(scene.camera.right, Vec3(-1, 0, 0)));
    CHECK(scene.camera.tan_half_x == Catch::Approx(12.5 / 35).epsilon(1e-5));
    const Vec3 inside(276, 270, 280);
    for (std::size_t i = 0; i < 5; ++i) {
      const auto& wall = std::get<Parallelogram>(scene.shapes.at(i).geometry);
      CHECK(glm::dot(glm::cross(wall.u, wall.v), inside - wall.origin) > 0);
    }
    const auto& light = std::get<Parallelogram>(scene.shapes.at(17).geometry);
    CHECK(close(light.origin + 0.5f * (light.u + light.v), Vec3(278, 548.3f, 279.5f), 1e-3f));
    CHECK(glm::cross(light.u, light.v).y < 0);
  }
}

TEST_CASE("the reference scenes load whole", "[scene]") {
  for (const char* name : {"peer_cornell_lambert.xml", "peer_cornell_phong.xml"}) {
    const Scene scene = load_scene(source_dir / "tests/references" / name);
    INFO(name);
    CHECK(scene.notes.empty());
    const Needs n = needs(scene);
    CHECK(n.parallelograms == 18);
    CHECK(n.parallelogram_lights == 1);
    CHECK(scene.width == 256);
    CHECK(scene.max_depth == 65);
    CHECK(scene.camera.tan_half_x ==
          Catch::Approx(std::tan(9.75 * 3.14159265358979 / 180)).epsilon(1e-6));
    const auto& light = std::get<Parallelogram>(scene.shapes.at(17).geometry);
    CHECK(close(light.origin + 0.5f * (light.u + light.v), Vec3(-0.005f, 1.98f, -0.03f)));
    CHECK(close(glm::cross(light.u, light.v), Vec3(0, -0.1786f, 0), 1e-4f));
  }
}
