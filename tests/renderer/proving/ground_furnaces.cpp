// A closed room in which every visible surface emits E and reflects rho: each ray has the same
// radiance L = E + rho L = E / (1 - rho). Paths of at most K segments give E (1 + rho + ... +
// rho^(K-1)).

#include "proving/ground.h"
#include "proving/parts.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

const Rgb furnace_emission(1, .5f, .25f);

/// E (1 - rho^K) / (1 - rho); without a limit, K = 0, E / (1 - rho).
std::array<double, 3> furnace_radiance(double rho, int depth) {
  std::array<double, 3> exact = exact_of(furnace_emission);
  for (double& x : exact)
    x *= (depth == 0 ? 1 : 1 - std::pow(rho, depth)) / (1 - rho);
  return exact;
}

struct Furnace {
  float rho = .5f;
  int depth = 0;
  bool two_sided = false, phong = false;
};

Scene furnace_scene(const Furnace& f) {
  Scene scene = empty();
  scene.max_depth = f.depth;
  scene.materials = {f.phong ? lobeless_phong(Rgb(f.rho), f.two_sided)
                             : diffuse(Rgb(f.rho), f.two_sided)};
  scene.camera = camera_at({.1, .2, .3}, {1, .9, 1.1}, 100);
  return scene;
}

Proof furnace_proof(std::string name, Scene scene, const Furnace& f, const Placement& placement) {
  return {"furnace/" + std::move(name), placed(std::move(scene), placement),
          furnace_radiance(static_cast<double>(f.rho), f.depth), 256};
}

Scene boxed(const Furnace& f, double margin) {
  Scene scene = furnace_scene(f);
  add_box(scene, {dvec3(0), dvec3(1), glm::dmat3(1), margin}, {0, furnace_emission},
          Facing::inwards);
  return scene;
}

void boxes(std::vector<Proof>& proofs) {
  for (const float rho : {.125f, .5f, .875f}) {
    for (const bool two_sided : {false, true}) {
      for (const bool phong : {false, true}) {
        for (const int turn : {0, 3, 4}) {
          const Furnace f{rho, 0, two_sided, phong};
          proofs.push_back(furnace_proof(
              fmt::format("box/rho={:g}/{}/{}/turn={}", rho, two_sided ? "two-sided" : "one-sided",
                          phong ? "phong" : "diffuse", turn),
              boxed(f, 0), f, {rotation(turn)}));
        }
      }
    }
  }
}

void limited(std::vector<Proof>& proofs) {
  for (const float rho : {.125f, .5f, .875f}) {
    for (const int depth : {1, 2, 3, 5}) {
      for (const int turn : {0, 5}) {
        const Furnace f{rho, depth, turn == 0, turn != 0};
        proofs.push_back(furnace_proof(fmt::format("depth={}/rho={:g}/turn={}", depth, rho, turn),
                                       boxed(f, 0), f, {rotation(turn)}));
      }
    }
  }
}

/// Walls that cross at the edges, so that the room stays closed when corners are rounded.
void far_away(std::vector<Proof>& proofs) {
  for (const double scale : {1e-4, 1e-2, 1.0, 1e4, 1e6}) {
    for (const double shift : {0.0, 10.0, 1000.0}) {
      for (const int turn : {0, 6}) {
        const Furnace f{.5f, 0, false, false};
        proofs.push_back(
            furnace_proof(fmt::format("placed/scale={:g}/shift={:g}/turn={}", scale, shift, turn),
                          boxed(f, .05), f, {rotation(turn), scale, shift * dvec3(1, -.7, .4)}));
      }
    }
  }
}

/// From inside, off centre, as in a file from a user.
void spheres(std::vector<Proof>& proofs) {
  for (const float rho : {.125f, .5f, .875f}) {
    for (const double radius : {.37, 1.0, 1e3}) {
      for (const bool off : {false, true}) {
        const Furnace f{rho, 0, off, false};
        Scene scene = furnace_scene(f);
        scene.shapes = {ball({0, 0, 0}, 1, {0, furnace_emission}, Facing::inwards)};
        const dvec3 shift = off ? dvec3(3, 2.7, -5) / .37 : dvec3(0);
        proofs.push_back(furnace_proof(
            fmt::format("sphere/rho={:g}/radius={:g}/{}", rho, radius, off ? "off" : "centred"),
            std::move(scene), f, {rotation(0), radius, shift}));
      }
    }
  }
}

/// Six disks that cover a cube's faces and cross.
void disks(Scene& scene) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      carlo::Vec3 out(0);
      out[axis] = side;
      scene.shapes.push_back({carlo::Disk{out, -out, 1.5f}, 0, furnace_emission});
    }
  }
}

/// The inside of an octahedron: its triangles with the opposite orientation.
void triangles(Scene& scene) {
  carlo::Shape shape = octahedron({0, 0, 0}, 2, {0, furnace_emission});
  for (glm::uvec3& triangle : std::get<carlo::Mesh>(shape.geometry).triangles)
    std::swap(triangle.y, triangle.z);
  scene.shapes.push_back(std::move(shape));
}

void other_walls(std::vector<Proof>& proofs) {
  for (const bool mesh : {false, true}) {
    for (const float rho : {.125f, .5f, .875f}) {
      for (const double scale : {1e-3, 1.0, 1e5}) {
        const Furnace f{rho, 0, false, mesh};
        Scene scene = furnace_scene(f);
        (mesh ? triangles : disks)(scene);
        proofs.push_back(furnace_proof(
            fmt::format("{}/rho={:g}/scale={:g}", mesh ? "mesh" : "disks", rho, scale),
            std::move(scene), f, {rotation(8), scale}));
      }
    }
  }
}

}  // namespace

std::vector<Proof> furnace_proofs() {
  std::vector<Proof> proofs;
  boxes(proofs);
  limited(proofs);
  far_away(proofs);
  spheres(proofs);
  other_walls(proofs);
  return proofs;
}

}  // namespace proving
