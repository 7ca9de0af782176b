// Probes of exercise 9.4: they call the student's functions and return raw values;
// checks_photons.cpp and checks_photon_paths.cpp say what the values should be.

#include "09_bias/photon_scenes.h"
#include "bias.h"
#include "grader/worker/probe.h"
#include "random/rng.h"

#include <vector>

namespace lab09_photons {

using carlo::grader::RowWriter;

namespace {

double number(float x) {
  return static_cast<double>(x);
}

void add_emission(RowWriter& rows, const lab09::Emission& e) {
  rows.add({number(e.ray.o.x), number(e.ray.o.y), number(e.ray.o.z), number(e.ray.d.x),
            number(e.ray.d.y), number(e.ray.d.z), number(e.flux.r), number(e.flux.g),
            number(e.flux.b)});
}

}  // namespace

PROBE("Lab 9.4 point", "o.x", "o.y", "o.z", "d.x", "d.y", "d.z", "flux.r", "flux.g", "flux.b") {
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i)
    add_emission(rows, lab09::emit_from_point({1, 2, 3}, light_radiance, rng));
  return rows.take();
}

PROBE("Lab 9.4 light", "o.x", "o.y", "o.z", "d.x", "d.y", "d.z", "flux.r", "flux.g", "flux.b") {
  const lab08::World world(lone_light(static_cast<PhotonLight>(params.whole("light"))));
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i)
    add_emission(rows, lab09::emit_from_light(world.lights()[0], rng));
  return rows.take();
}

PROBE("Lab 9.4 lights", "o.x", "flux.r", "flux.g", "flux.b") {
  const bool weak = params.whole("weak") == 1;
  const lab08::World world(weak ? row_of(weak_and_strong) : row_of(coloured_lights));
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const lab09::Emission e = lab09::emit_photon(world, rng);
    rows.add({number(e.ray.o.x), number(e.flux.r), number(e.flux.g), number(e.flux.b)});
  }
  return rows.take();
}

// Where photons of a light at height 1 land: of a point light, or of a square one.
PROBE("Lab 9.4 landing", "x", "y", "how often it was stored") {
  const bool square = params.whole("square") == 1;
  const lab08::World world(landing_place(square));
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const lab09::Emission e = square ? lab09::emit_photon(world, rng)
                                     : lab09::emit_from_point({0, 0, 1}, light_radiance, rng);
    lab09::Photon last;
    double stored = 0;
    lab09::trace_photon(world, e, rng, [&](const lab09::Photon& photon) {
      last = photon;
      ++stored;
    });
    rows.add({number(last.p.x), number(last.p.y), stored});
  }
  return rows.take();
}

// The first photons stored for each one sent.
PROBE("Lab 9.4 stored", "p.x", "p.y", "p.z", "wi.x", "wi.y", "wi.z", "flux.r", "flux.g", "flux.b",
      "phong", "specular", "how many were stored",
      "(three rows for each photon sent; 0 where fewer were stored)") {
  constexpr std::size_t shown = 3;
  const auto place = static_cast<PhotonPlace>(params.whole("place"));
  const lab08::World world(photon_scene(place));
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    std::vector<lab09::Photon> stored;
    double count = 0;
    lab09::trace_photon(world, {sent_ray(place, i), sent_flux}, rng,
                        [&](const lab09::Photon& photon) {
                          if (stored.size() < shown) stored.push_back(photon);
                          ++count;
                        });
    stored.resize(shown);
    for (const auto& [p, wi, flux, phong, specular] : stored) {
      rows.add({number(p.x), number(p.y), number(p.z), number(wi.x), number(wi.y), number(wi.z),
                number(flux.r), number(flux.g), number(flux.b), static_cast<double>(phong),
                static_cast<double>(specular), count});
    }
  }
  return rows.take();
}

// The total flux stored for one photon.
PROBE("Lab 9.4 sums", "red", "green", "blue", "how often it was stored") {
  const auto place = static_cast<PhotonPlace>(params.whole("place"));
  const lab08::World world(photon_scene(place));
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    glm::dvec3 sum(0);
    double stored = 0;
    lab09::trace_photon(world, {sent_ray(place, i), sent_flux}, rng,
                        [&](const lab09::Photon& photon) {
                          sum += photon.flux;
                          ++stored;
                        });
    rows.add({sum.r, sum.g, sum.b, stored});
  }
  return rows.take();
}

}  // namespace lab09_photons
