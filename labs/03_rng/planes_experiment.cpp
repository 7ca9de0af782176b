#include "course/viewer/turntable.h"
#include "experiments.h"
#include "generators.h"
#include "spectral.h"
#include "support/wall_clock.h"

#include <algorithm>
#include <array>
#include <cmath>

// The planes: drawn, and measured by the spectral test.

namespace lab03 {
namespace {

using carlo::Cloud;

std::array<double, 3> normal_of(const DualVector& dual) {
  return {static_cast<double>(dual.s[0]), static_cast<double>(dual.s[1]),
          static_cast<double>(dual.s[2])};
}

Cloud triples(const std::string& key, const std::string& name, const std::string& note,
              std::uint64_t seed, std::array<double, 3> normal) {
  std::vector<std::uint32_t> words(3 * 4000);
  find_generator(key).make(seed)(words);
  Cloud cloud{name, note, {}, normal};
  for (std::size_t i = 0; i < words.size(); i += 3)
    cloud.points.push_back({words[i] * 0x1p-32, words[i + 1] * 0x1p-32, words[i + 2] * 0x1p-32});
  return cloud;
}

/// All triples (x_n, x_{n+1}, x_{n+2}) of the LCG's whole period in the corner [0, 1/128)^3,
/// enlarged.
Cloud corner_of_lcg(std::array<double, 3> normal) {
  constexpr std::uint32_t side = std::uint32_t{1} << 25;
  Cloud cloud{
      "LCG, a corner 128 times as large",
      "All triples of the lecture's LCG in a corner of the cube, 1/128 wide: there are planes "
      "after all, some 2000 of them from corner to corner.",
      {},
      normal};
  for (std::uint32_t x = 0; x < side; ++x) {
    Lcg generator(x);
    const std::uint32_t y = generator.next();
    if (y >= side) continue;
    const std::uint32_t z = generator.next();
    if (z >= side) continue;
    cloud.points.push_back({x * 0x1p-25, y * 0x1p-25, z * 0x1p-25});
  }
  return cloud;
}

/// The first triples of a cloud, flattened: as the cube shows them from the front, and from the
/// side where its planes are lines.
carlo::Table views_table(const Cloud& cloud) {
  constexpr std::size_t drawn = 800;
  const auto [a, b, c] = cloud.normal;
  const double length = std::hypot(a, b, c), across = std::hypot(a, b);
  carlo::Table table({"view", "across", "up"}, {"view", "across", "up"});
  for (std::size_t i = 0; i < std::min(drawn, cloud.points.size()); ++i) {
    const auto [x, y, z] = cloud.points[i];
    table.add_row({"front", x, y});
    table.add_row({"side", (a * x + b * y + c * z) / length, (b * x - a * y) / across});
  }
  return table;
}

struct Constants {
  const char* name;
  std::uint64_t a, b, c;
  /// c, unless the states form a coarser lattice. RANDU's are odd: x = 2 y + 1, and y runs modulo
  /// c/2.
  std::uint64_t lattice;
};

constexpr std::array<Constants, 5> known = {
    {{"LCG (lecture)", Lcg::a, Lcg::b, std::uint64_t{1} << 32, std::uint64_t{1} << 32},
     {"RANDU", 65539, 0, std::uint64_t{1} << 31, std::uint64_t{1} << 30},
     {"MINSTD, 16807", 16807, 0, 2147483647, 2147483647},
     {"MINSTD, 48271", 48271, 0, 2147483647, 2147483647},
     {"a = 69069", 69069, 1, std::uint64_t{1} << 32, std::uint64_t{1} << 32}}};

void spectral_table(Notebook& notebook) {
  carlo::Table table({"generator", "ν₂ (yours)", "ν₂²", "ν₃", "planes, at most", "ν₄", "time"},
                     {"generator", "nu_2", "nu_2_squared", "nu_3", "planes_3d", "nu_4", "seconds"});
  for (const Constants& g : known) {
    const carlo::WallClock clock;
    carlo::Cell length = carlo::empty_cell(), squared = carlo::empty_cell();
    notebook.attempt([&] {
      const std::uint64_t yours = spectral_2d(g.a, g.lattice);
      length = carlo::Cell(std::round(std::sqrt(static_cast<double>(yours))));
      squared = carlo::Cell(static_cast<std::int64_t>(yours));
    });
    const DualVector three = shortest_dual_vector(g.a, g.c, 3);
    const auto quick = notebook.options().quick;
    const carlo::Cell four =
        quick ? carlo::empty_cell()
              : carlo::Cell(std::round(shortest_dual_vector(g.a, g.lattice, 4).length()));
    const double spent = clock.seconds();
    table.add_row({g.name, length, squared, carlo::Cell(three.length()), three.planes(g.b != 0),
                   four, carlo::seconds_cell(spent)});
  }
  notebook.say(
      "The spectral test measures without drawing: 1/ν_d is the greatest distance between "
      "neighbouring hyperplanes that hold all d-tuples. A perfect lattice of 2^32 points would "
      "have ν₂ near 70 000, ν₃ near 1800 and ν₄ near 300.");
  notebook.table("spectral", table, "The spectral test, exact in integers");
}

/// The edges of the unit cube.
std::vector<carlo::Polyline> cube_wires() {
  std::vector<carlo::Polyline> edges;
  const auto corner = [](unsigned k) -> std::array<double, 3> {
    return {static_cast<double>(k & 1), static_cast<double>(k >> 1 & 1),
            static_cast<double>(k >> 2)};
  };
  for (unsigned i = 0; i < 8; ++i) {
    for (const unsigned bit : {1U, 2U, 4U}) {
      if ((i & bit) == 0) edges.push_back({corner(i), corner(i | bit)});
    }
  }
  return edges;
}

}  // namespace

void planes_experiment(Notebook& notebook) {
  notebook.begin("Planes");
  const std::uint64_t seed = notebook.options().seed;
  const auto randu = shortest_dual_vector(65539, std::uint64_t{1} << 31, 3);
  const auto lcg = shortest_dual_vector(Lcg::a, std::uint64_t{1} << 32, 3);
  std::vector<Cloud> clouds = {triples("randu", "RANDU",
                                       "4000 triples of RANDU. From most sides they look random.",
                                       seed, normal_of(randu))};
  notebook.attempt([&] {
    clouds.push_back(
        triples("lcg", "LCG (lecture)",
                "4000 triples of the lecture's LCG: its planes are too close to be seen.", seed,
                normal_of(lcg)));
    clouds.push_back(corner_of_lcg(normal_of(lcg)));
  });
  notebook.attempt([&] {
    clouds.push_back(triples("pcg32", "PCG32", "4000 triples of PCG32: no planes from any side.",
                             seed, {0, 0, 0}));
  });
  notebook.say(
      "Three numbers in a row make a point. Those of a linear congruential generator lie on "
      "parallel planes (Marsaglia, \"Random numbers fall mainly in the planes\", 1968); the page "
      "has a cube that you can turn.");
  const carlo::Turntable cube{"Triples of numbers as points of a cube", "Points in a cube.",
                              "Look along the planes", cube_wires(), clouds};
  notebook.raw_html(turntable_html(cube));
  notebook.script(carlo::turntable_script());
  notebook.data("planes", views_table(clouds.front()), "RANDU from the front and along its planes");
  spectral_table(notebook);
}

}  // namespace lab03
