#include "proving/scene_xml.h"

#include "image/exr.h"

#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <variant>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene, carlo::Shape, carlo::Vec3;
using glm::dvec3;

std::string colour(const char* name, const Rgb& c) {
  return fmt::format("<rgb name=\"{}\" value=\"{:.9g}, {:.9g}, {:.9g}\"/>", name, c.x, c.y, c.z);
}

std::string point(const char* name, const Vec3& p) {
  return fmt::format("<point name=\"{}\" x=\"{:.9g}\" y=\"{:.9g}\" z=\"{:.9g}\"/>", name, p.x, p.y,
                     p.z);
}

/// The transform with these columns.
std::string to_world(const dvec3& x, const dvec3& y, const dvec3& z, const dvec3& origin) {
  std::string rows;
  for (int i = 0; i < 3; ++i)
    rows += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}  ", x[i], y[i], z[i], origin[i]);
  return fmt::format("<transform name=\"toWorld\"><matrix value=\"{}0 0 0 1\"/></transform>", rows);
}

struct MaterialText {
  std::string operator()(const carlo::Diffuse& m) const {
    return "<bsdf type=\"diffuse\">" + colour("reflectance", m.reflectance) + "</bsdf>";
  }
  std::string operator()(const carlo::Phong& m) const {
    return "<bsdf type=\"phong\">" + colour("diffuseReflectance", m.kd) +
           colour("specularReflectance", m.ks) +
           fmt::format("<float name=\"exponent\" value=\"{:.9g}\"/></bsdf>", m.exponent);
  }
  std::string operator()(const carlo::Mirror& m) const {
    return "<bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/>" +
           colour("specularReflectance", m.reflectance) + "</bsdf>";
  }
  std::string operator()(const carlo::Dielectric& m) const {
    return fmt::format(
        "<bsdf type=\"dielectric\"><float name=\"intIOR\" value=\"{:.9g}\"/>"
        "<float name=\"extIOR\" value=\"{:.9g}\"/></bsdf>",
        m.int_ior, m.ext_ior);
  }
};

/// The contents of <bsdf id="..."> have no id of their own, so the id goes into the first tag.
std::string material_text(const carlo::Material& material, std::size_t number) {
  std::string text = std::visit(MaterialText{}, material.model);
  const bool wrapped =
      material.two_sided && !std::holds_alternative<carlo::Dielectric>(material.model);
  if (wrapped) text = "<bsdf type=\"twosided\">" + text + "</bsdf>";
  return text.insert(5, fmt::format(" id=\"m{}\"", number));
}

/// The element's type and its geometry.
struct GeometryText {
  std::string mesh_file;

  std::string operator()(const carlo::Parallelogram& s) const {
    const dvec3 u = .5 * dvec3(s.u), v = .5 * dvec3(s.v);
    return "\"rectangle\">" +
           to_world(u, v, glm::normalize(glm::cross(u, v)), dvec3(s.origin) + u + v);
  }
  std::string operator()(const carlo::Sphere& s) const {
    return "\"sphere\">" + point("center", s.center) +
           fmt::format("<float name=\"radius\" value=\"{:.9g}\"/>", s.radius) +
           (s.flipped ? "<boolean name=\"flipNormals\" value=\"true\"/>" : "");
  }
  std::string operator()(const carlo::Disk& s) const {
    const dvec3 n = glm::normalize(dvec3(s.normal));
    const dvec3 x =
        glm::normalize(glm::cross(std::abs(n.x) < .6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), n));
    const auto r = static_cast<double>(s.radius);
    return "\"disk\">" + to_world(r * x, r * glm::cross(n, x), n, dvec3(s.center));
  }
  std::string operator()(const carlo::Mesh&) const {
    return fmt::format("\"obj\"><string name=\"filename\" value=\"{}\"/>", mesh_file);
  }
  std::string operator()(const carlo::Sdf&) const { return "\"sdf\">"; }  // no scene here has one
};

std::string mesh_text(const carlo::Mesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.positions)
    text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles)
    text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  return text;
}

std::string mesh_name(const std::string& name, std::size_t number) {
  return fmt::format("{}_mesh_{}.obj", name, number);
}

std::string shape_text(const Shape& shape, const std::string& mesh_file) {
  std::string text = "  <shape type=" + std::visit(GeometryText{mesh_file}, shape.geometry) +
                     fmt::format("<ref id=\"m{}\"/>", shape.material);
  if (shape.emits())
    text += "<emitter type=\"area\">" + colour("radiance", shape.radiance) + "</emitter>";
  return text + "</shape>\n";
}

/// The film is square.
std::string sensor_text(const Scene& scene) {
  const carlo::Camera& c = scene.camera;
  const double fov =
      2 * std::atan(static_cast<double>(c.tan_half_x)) * 180 / 3.14159265358979323846;
  return fmt::format("  <sensor type=\"perspective\"><float name=\"fov\" value=\"{:.9g}\"/>", fov) +
         to_world(-dvec3(c.right), dvec3(c.up), dvec3(c.forward), dvec3(c.origin)) +
         fmt::format(
             "\n    <film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/>"
             "<integer name=\"height\" value=\"{}\"/></film>\n"
             "    <sampler type=\"independent\"><integer name=\"sampleCount\" value=\"{}\"/>"
             "</sampler></sensor>\n",
             scene.width, scene.height, scene.spp);
}

std::string image_name(const std::string& name) {
  return name + "_image.exr";
}

std::string image_text(const carlo::Envmap& map, const std::string& file) {
  return fmt::format("  <emitter type=\"envmap\"><string name=\"filename\" value=\"{}\"/>", file) +
         to_world(map.rotation[0], map.rotation[1], map.rotation[2], dvec3(0)) + "</emitter>\n";
}

std::string text_of(const Scene& scene, const std::string& comment, const std::string& name) {
  std::string text = fmt::format("<scene version=\"0.6.0\">  <!-- {} -->\n", comment);
  text += fmt::format(
      "  <integrator type=\"path\"><integer name=\"maxDepth\" value=\"{}\"/></integrator>\n",
      scene.max_depth == 0 ? -1 : scene.max_depth);
  text += sensor_text(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    text += "  " + material_text(scene.materials[i], i) + "\n";
  for (std::size_t i = 0; i < scene.shapes.size(); ++i)
    text += shape_text(scene.shapes[i], mesh_name(name, i));
  const auto& [points, environment, envmap] = scene.lights;
  if (envmap) text += image_text(*envmap, image_name(name));
  for (const carlo::PointLight& light : points) {
    text += "  <emitter type=\"point\">" + point("position", light.position) +
            colour("intensity", light.intensity) + "</emitter>\n";
  }
  if (environment != Rgb(0))
    text += "  <emitter type=\"constant\">" + colour("radiance", environment) + "</emitter>\n";
  return text + "</scene>\n";
}

}  // namespace

std::string scene_xml(const Scene& scene, const std::string& comment) {
  return text_of(scene, comment, "scene");
}

std::filesystem::path write_scene(const Scene& scene, const std::filesystem::path& folder,
                                  const std::string& name, const std::string& comment) {
  std::filesystem::create_directories(folder);
  std::filesystem::path path = folder / (name + ".xml");
  std::ofstream(path) << text_of(scene, comment, name);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (const auto* mesh = std::get_if<carlo::Mesh>(&scene.shapes[i].geometry))
      std::ofstream(folder / mesh_name(name, i)) << mesh_text(*mesh);
  }
  if (scene.lights.envmap)
    carlo::write_exr(folder / image_name(name), {scene.lights.envmap->image});
  return path;
}

}  // namespace proving
