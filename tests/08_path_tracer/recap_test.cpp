// The Recap as printed and as corrected, against closed forms.
//
// Means are judged with theory's standard deviation, not with the sample's own: about twenty z
// tests at |z| < 5.5 raise a false alarm in less than 1e-6 of all runs (4e-8 each). n paths detect
// a bias of 8.6 standard errors with power .999: 2.7 % in the worst case below, where one path's
// standard deviation is 1.4 times its mean and n = 200 000.

#include "recap_room.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <numbers>
#include <vector>

using namespace lab08;

namespace {

constexpr double pi = std::numbers::pi;
constexpr int many_paths = 200'000;

struct Theory {
  double mean = 0, square = 0;
  double sd() const { return std::sqrt(square - mean * mean); }
};

/// Moments of the cosine over the wall's two sets of directions, each uniform in its set.
struct Cosines {
  double light, light_squared, other, other_squared;

  explicit Cosines(const RecapRoom& room) {
    const double c = std::sqrt(1 - room.ball * room.ball), solid = 2 * pi * (1 - c);
    light = pi * (1 - c * c) / solid;
    light_squared = 2 * pi / 3 * (1 - c * c * c) / solid;
    other = pi * c * c / (2 * pi - solid);
    other_squared = 2 * pi / 3 * c * c * c / (2 * pi - solid);
  }
};

/// p_emit of the wall.
double emits(const RecapRoom& room) {
  return room.wall_emits > 0 ? 0.9 : 0;
}

/// One path of recap_as_printed(): with probability p the value Le / p, otherwise (A + B X) / (1 -
/// p), where A is the light ray's contribution and X another path's value.
Theory recap_theory(const RecapRoom& room) {
  const Cosines cosines(room);
  const double solid = room.solid_angle(), p = emits(room), f = room.albedo / pi;
  const double a = 0.5 / solid * f * room.ball_radiance, b = 0.5 * (1 - 1 / solid) * f;
  const double mean = (room.wall_emits + a * cosines.light) / (1 - b * cosines.other);
  const double emitted = p > 0 ? room.wall_emits * room.wall_emits / p : 0;
  const double square =
      emitted +
      (a * a * cosines.light_squared + 2 * a * cosines.light * b * cosines.other * mean) / (1 - p);
  return {mean, square / (1 - b * b * cosines.other_squared / (1 - p))};
}

/// The same for random_direction_as_printed().
Theory random_direction_theory(const RecapRoom& room) {
  const Cosines cosines(room);
  const double to_ball = room.solid_angle() / (2 * pi), p = emits(room), f = room.albedo / pi;
  const double ball = room.ball_radiance;
  const double mean = (room.wall_emits + f * to_ball * cosines.light * ball) /
                      (1 - f * (1 - to_ball) * cosines.other);
  const double emitted = p > 0 ? room.wall_emits * room.wall_emits / p : 0;
  const double square = emitted + f * f * to_ball * cosines.light_squared * ball * ball / (1 - p);
  return {mean, square / (1 - f * f * (1 - to_ball) * cosines.other_squared / (1 - p))};
}

/// recap_mended(): Le, and one of three: with probability 1 - albedo the light ray, with
/// probability albedo (1 - F) another path's value, otherwise nothing.
Theory mended_theory(const RecapRoom& room) {
  const Cosines cosines(room);
  const double q = 1 - room.albedo, on = room.albedo * (1 - room.view_factor());
  const double light = room.solid_angle() * room.albedo / pi * room.ball_radiance / q;
  const double mean = (room.wall_emits + q * light * cosines.light) / (1 - on);
  const double Le = room.wall_emits;
  const double square = Le * Le + 2 * Le * (mean - Le) + q * light * light * cosines.light_squared;
  return {mean, square / (1 - on)};
}

struct Paths {
  double mean = 0, calls = 0, cut = 0;
};

Paths paths(const World& world, const BallLight& light, const carlo::Ray& ray, RecapForm form,
            int n, int most_calls, carlo::Rng& rng) {
  Paths sum;
  for (int i = 0; i < n; ++i) {
    const RecapPath path = form(world, light, ray, most_calls, rng);
    sum.mean += static_cast<double>(path.radiance.r);
    sum.calls += path.calls;
    sum.cut += path.cut ? 1 : 0;
  }
  return {sum.mean / n, sum.calls / n, sum.cut / n};
}

Paths paths(const RecapRoom& room, RecapForm form, int n, int most_calls, std::uint64_t stream) {
  const World world(room.scene());
  carlo::Rng rng(23, stream);
  return paths(world, room.light(), RecapRoom::ray(), form, n, most_calls, rng);
}

void check_mean(double mean, double exact, double sd, int n) {
  const double z = (mean - exact) / (sd / std::sqrt(n));
  INFO("mean " << mean << " for " << exact << ", z = " << z);
  CHECK(std::abs(z) < 5.5);
}

/// Walls that emit and walls that do not, a large ball and a small one.
const std::vector<RecapRoom>& rooms() {
  static const std::vector<RecapRoom> all = {
      {0.3, 0.5, 1, 2}, {0.3, 0.8, 1, 0.5}, {0.5, 0.5, 0, 10}, {0.8, 0.7, 0, 1}};
  return all;
}

}  // namespace

TEST_CASE("the room of the Recap: what is emitted is absorbed") {
  for (const RecapRoom& room : rooms()) {
    const double F = room.view_factor(), wall = room.exact(), ball = room.ball_radiance;
    // Over pi and per unit of the wall; the ball absorbs what it receives.
    const double emitted = room.wall_emits + F * ball;
    const double absorbed = (1 - room.albedo) * (F * ball + (1 - F) * wall) + F * wall;
    CHECK(std::abs(emitted - absorbed) < 1e-12 * emitted);
  }
  const RecapRoom furnace{0.8, 0.4, 1, 1 / (1 - 0.8)};
  CHECK(std::abs(furnace.exact() - 5) < 1e-12);
}

TEST_CASE("the room of the Recap: the printed forms' means are those of their rays") {
  for (const RecapRoom& room : rooms()) {
    const auto close = [](double a, double b) { return std::abs(a - b) < 1e-12 * std::abs(b); };
    CHECK(close(room.recap_mean(), recap_theory(room).mean));
    CHECK(close(room.random_direction_mean(), random_direction_theory(room).mean));
    CHECK(close(room.exact(), mended_theory(room).mean));
  }
  // Weights of 1/2 p_light and 1/2 (1 - p_light) instead of Omega and 2 pi - Omega: with a ball of
  // solid angle 1 the non-light ray has weight 0, with a smaller one a negative weight.
  RecapRoom room{0.5, std::sqrt(1 - std::pow(1 - 1 / (2 * pi), 2)), 0, 1};
  CHECK(std::abs(room.solid_angle() - 1) < 1e-12);
  CHECK(std::abs(room.light_ratio() - 0.5) < 1e-12);
  CHECK(std::abs(room.non_light_ratio()) < 1e-12);
  room.ball /= 10;
  CHECK(room.non_light_ratio() < -1);
  CHECK(std::isinf(RecapRoom{0.9, room.ball, 0, 1}.recap_mean()));
}

TEST_CASE("the Recap as printed brings what its weights say, and not what it should") {
  std::uint64_t stream = 0;
  for (const RecapRoom& room : rooms()) {
    constexpr int n = many_paths / 10;
    const Theory recap = recap_theory(room), random = random_direction_theory(room);
    // Where no path ends by itself, the remainder after 32 calls has a factor of at most 1e-16.
    check_mean(paths(room, recap_as_printed, n, 32, stream++).mean, recap.mean, recap.sd(), n);
    check_mean(paths(room, random_direction_as_printed, n, 1 << 12, stream++).mean, random.mean,
               random.sd(), n);
    CHECK(std::abs(recap.mean / room.exact() - 1) > 0.1);
    CHECK(random.mean / room.exact() < 0.9);
  }
}

TEST_CASE("the mended Recap brings what the room shows, with the variance of theory") {
  std::uint64_t stream = 100;
  for (const RecapRoom& room : rooms()) {
    const Theory theory = mended_theory(room);
    check_mean(paths(room, recap_mended, many_paths, 1 << 12, stream++).mean, room.exact(),
               theory.sd(), many_paths);
  }
  // The mean z^2 of 1000 means of 500 paths is 1 with a deviation of sqrt(2/1000) = .045 (1/500 of
  // a path's excess kurtosis more): alpha < 1e-6; a standard deviation off by 15 % is detected with
  // power .999.
  const RecapRoom room = rooms().front();
  const Theory theory = mended_theory(room);
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    const double mean = paths(room, recap_mended, 500, 1 << 12, 1000 + stream++).mean;
    const double z = (mean - theory.mean) / (theory.sd() / std::sqrt(500.0));
    sum += z * z / 1000;
  }
  INFO("mean z^2 " << sum);
  CHECK(std::abs(sum - 1) < 0.25);
}

TEST_CASE("the Recap calls itself as often as it must, and where walls are dark for ever") {
  const RecapRoom bright = rooms()[0], dark = rooms()[2];
  constexpr int n = many_paths / 10;
  // Two calls with probability 1/10; the light ray's is the last of its kind.
  check_mean(paths(bright, recap_as_printed, n, 1 << 12, 200).calls, 1 + 2 / 9.0,
             2 * std::sqrt(0.1) / 0.9, n);
  const Paths printed = paths(dark, recap_as_printed, 1000, 64, 201);
  // Except for the one in about 10^5 that grazes the wall or, by rounding, the ball: no z test.
  CHECK(printed.cut > 0.99);
  CHECK(printed.calls > 63);
  // One random direction ends when it meets the ball.
  const double s = dark.solid_angle() / (2 * pi);
  check_mean(paths(dark, random_direction_as_printed, n, 1 << 12, 202).calls, 1 + 1 / s,
             std::sqrt(1 - s) / s, n);
  // Corrected: a geometric number of non-light rays, then perhaps a light ray.
  for (const RecapRoom& room : {bright, dark}) {
    const double on = room.albedo * (1 - room.view_factor()), light = (1 - room.albedo) / (1 - on);
    const Paths mended = paths(room, recap_mended, n, 1 << 12, 203);
    check_mean(mended.calls, 1 + on / (1 - on) + light,
               std::sqrt(on / ((1 - on) * (1 - on)) + light * (1 - light)), n);
    CHECK(mended.cut == 0);
  }
}

namespace {

/// A floor under a sky of radiance 1.
carlo::Scene floor_under_sky(const carlo::Material& material) {
  carlo::Scene scene;
  scene.materials = {material, {carlo::Diffuse{Rgb(0)}, false}};
  scene.shapes = {{carlo::Parallelogram{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, 0, Rgb(0)}};
  scene.lights.environment = Rgb(1);
  return scene;
}

void add_ball(carlo::Scene& scene, const BallLight& ball, float radiance) {
  scene.shapes.push_back({carlo::Sphere{ball.centre, ball.radius}, 1, Rgb(radiance)});
}

/// At the origin of the floor, seen at this many degrees off its normal. One path's value lies
/// between 0 and `most`, so its standard deviation is at most half of that.
void check_floor(const carlo::Scene& scene, const BallLight& light, double degrees, double exact,
                 double most, std::uint64_t stream) {
  const World world(scene);
  const double angle = degrees * pi / 180;
  const Vec3 wo(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
  carlo::Rng rng(23, stream);
  const Paths found =
      paths(world, light, {1e-3f * wo, -wo}, recap_mended, many_paths, 1 << 12, rng);
  check_mean(found.mean, exact, most / 2, many_paths);
}

}  // namespace

TEST_CASE("the mended Recap with a light half set, and one behind a pillar") {
  constexpr double albedo = 0.6;
  const carlo::Material grey{carlo::Diffuse{Rgb(static_cast<float>(albedo))}, false};
  // Irradiance from a ball of radiance 1 at distance 2 radii, its centre on the horizon.
  constexpr double set = 0.0905861;
  const BallLight low{{2, 0, 0}, 1};
  carlo::Scene scene = floor_under_sky(grey);
  add_ball(scene, low, 4);
  // At most one light ray: solid angle .842, cosine .5, f = .6/pi, radiance 4, over .4.
  check_floor(scene, low, 30, albedo / pi * (4 * set + pi - set), 1, 300);

  // An emitting pillar that hides more than the light; radius 1/2 at distance 1.
  const BallLight hidden{{0, 0, 4}, 0.5f}, pillar{{0, 0, 1}, 0.5f};
  scene = floor_under_sky(grey);
  add_ball(scene, hidden, 100);
  add_ball(scene, pillar, 3);
  check_floor(scene, hidden, 60, albedo / pi * (3 * pi / 4 + pi - pi / 4), 3, 301);
}

TEST_CASE("the mended Recap on a glossy floor under a sky and a light as bright") {
  // The reflectance of a lobe of exponent 2 at 60 degrees is 9/16 (J. Arvo's recurrence). No weight
  // is above (n + 2)/(n + 1) = 4/3.
  const BallLight light{{-2, 0, 1.5f}, 0.6f};
  carlo::Scene scene = floor_under_sky({carlo::Phong{Rgb(0.3f), Rgb(0.5f), 2}, false});
  add_ball(scene, light, 1);
  check_floor(scene, light, 60, 0.3 + 0.5 * 0.5625, 1.5, 302);
}

TEST_CASE("the mended Recap refuses a surface that absorbs nothing") {
  const RecapRoom room{1, 0.5, 0, 1};
  CHECK_THROWS_AS(paths(room, recap_mended, 1, 16, 400), carlo::Error);
}
