#include "scenes.h"

#include "scene/match.h"
#include "support/error.h"

#include <utility>

namespace site {
namespace {

using carlo::Scene;
using carlo::Vec3;

/// Numbers that are written or read, so that one function says the order for both.
class Stream {
 public:
  explicit Stream(Numbers* out) : out_(out) {}
  explicit Stream(std::span<const double> in) : in_(in) {}

  template <class T>
  void operator()(T& value) {
    if (out_ != nullptr)
      out_->push_back(static_cast<double>(value));
    else
      value = static_cast<T>(in_[at_++]);
  }
  void operator()(Vec3& v) {
    for (int i = 0; i < 3; ++i)
      (*this)(v[i]);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    std::size_t count = list.size();
    (*this)(count);
    list.resize(count);
    for (T& one : list)
      fields(*this, one);
  }
  /// The alternative of a variant, then its members.
  template <class... Kinds>
  void kind(std::variant<Kinds...>& value) {
    std::size_t index = value.index();
    (*this)(index);
    std::size_t number = 0;
    ((out_ == nullptr && number++ == index ? void(value.template emplace<Kinds>()) : void()), ...);
    std::visit([&](auto& one) { fields(*this, one); }, value);
  }

 private:
  Numbers* out_ = nullptr;
  std::span<const double> in_;
  std::size_t at_ = 0;

  static void fields(Stream& s, carlo::Diffuse& m) { s(m.reflectance); }
  static void fields(Stream& s, carlo::Phong& m) { s(m.kd), s(m.ks), s(m.exponent); }
  static void fields(Stream& s, carlo::Mirror& m) { s(m.reflectance); }
  static void fields(Stream& s, carlo::Dielectric& m) { s(m.int_ior), s(m.ext_ior); }
  static void fields(Stream& s, carlo::Parallelogram& g) { s(g.origin), s(g.u), s(g.v); }
  static void fields(Stream& s, carlo::Sphere& g) { s(g.center), s(g.radius), s(g.flipped); }
  static void fields(Stream& s, carlo::Disk& g) { s(g.center), s(g.normal), s(g.radius); }
  static void fields(Stream&, carlo::Mesh&) { throw carlo::Error("the site has no triangles"); }
  static void fields(Stream&, carlo::Sdf&) {
    throw carlo::Error("the site has no signed distance functions");
  }
  static void fields(Stream& s, carlo::Material& m) { s.kind(m.model), s(m.two_sided); }
  static void fields(Stream& s, carlo::Shape& shape) {
    s.kind(shape.geometry), s(shape.material), s(shape.radiance);
  }
};

void fields(Stream& s, Scene& scene) {
  carlo::Camera& camera = scene.camera;
  s(camera.origin), s(camera.right), s(camera.up), s(camera.forward), s(camera.tan_half_fov);
  s(scene.lights.environment), s(scene.materials), s(scene.shapes);
}

std::vector<Scene> scenes;

/// The numbers of numbers_of(): returns the scene's number.
const Function add("scene.add", [](const Arguments& given) -> Numbers {
  Stream stream(given.from(0));
  fields(stream, scenes.emplace_back());
  return {static_cast<double>(scenes.size() - 1)};
});

}  // namespace

Numbers numbers_of(Scene scene) {
  if (scene.lights.envmap || !scene.lights.points.empty())
    throw carlo::Error("lab 8 supports neither point lights nor images as lights");
  Numbers numbers;
  Stream stream(&numbers);
  fields(stream, scene);
  return numbers;
}

Scene scene_with_film(std::size_t number, int size) {
  Scene scene = scenes.at(number);
  scene.camera.fit_film(size, size);
  return scene;
}

}  // namespace site
