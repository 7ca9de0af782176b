#include "image/exr.h"
#include "image/film.h"
#include "image/metrics.h"
#include "image/png.h"
#include "numeric/exact_sum.h"
#include "random/rng.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "temporary_folder.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace carlo;
using common_test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("A film's bits do not depend on the order of blocks nor on how films are merged") {
  Rng rng(1);
  std::vector<std::array<double, 3>> blocks(500);
  for (auto& b : blocks) {
    for (double& x : b)
      x = std::exp(20 * rng.uniform() - 15);  // 1e-7 ... 1e2
  }
  Film forward(1, 1, 4), backward(1, 1, 4), left(1, 1, 4), right(1, 1, 4);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    forward.add_block(0, 0, blocks[i]);
    backward.add_block(0, 0, blocks[blocks.size() - 1 - i]);
    (i % 3 == 0 ? left : right).add_block(0, 0, blocks[i]);
  }
  right.merge(left);
  for (const Film* film : {&backward, &right}) {
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(film->mean(0, 0, c) == forward.mean(0, 0, c));
      CHECK(film->variance(0, 0, c) == forward.variance(0, 0, c));
    }
  }
}

TEST_CASE("A film keeps values far below the brightest light") {
  // A tiny light of radiance 1e8 may light a room to 1.
  Film film(1, 1, 1);
  for (int i = 0; i < 100; ++i)
    film.add_block(0, 0, {1e-3 * (1 + i % 2), 1, 1e8});
  CHECK(std::abs(film.mean(0, 0, 0) - 1.5e-3) <= 1e-9);
  CHECK(film.mean(0, 0, 1) == 1);
  CHECK(film.mean(0, 0, 2) == 1e8);
}

TEST_CASE("A film's standard error is the textbook's, and infinite for one block") {
  Film film(2, 1, 8);
  CHECK(std::isinf(film.variance(1, 0, 0)));
  const std::vector<double> x = {1, 2, 4, 5};
  for (const double v : x)
    film.add_block(0, 0, {v, v, v});
  // mean 3, sum of squared deviations 10, variance of the mean 10 / 3 / 4
  CHECK(film.mean(0, 0, 0) == 3);
  CHECK(std::abs(film.variance(0, 0, 0) - 10.0 / 12) <= 1e-12);
  CHECK(film.samples() == 32);
}

TEST_CASE("A film's standard error is honest: z-scores of known means have unit variance") {
  // 2000 pixels of 64 uniform samples each: the sum of z^2 is chi-square with about 2000 degrees of
  // freedom (heavier-tailed: t with 63), the sd of its mean .033; the bound is 5 of those.
  Rng rng(3);
  double sum = 0;
  for (int pixel = 0; pixel < 2000; ++pixel) {
    Film film(1, 1, 1);
    for (int i = 0; i < 64; ++i) {
      const double u = rng.uniform();
      film.add_block(0, 0, {u, u, u});
    }
    const double d = film.mean(0, 0, 0) - 0.5;
    sum += d * d / film.variance(0, 0, 0);
  }
  CHECK(std::abs(sum / 2000 - 63.0 / 61) <= 5 * 0.033);
}

TEST_CASE("An exact sum is the same in any order and any parts, over the range of doubles") {
  // Terms of 1e-300 to 1e300, some of which cancel: the digits of the largest are kept, so the sum
  // is right to 2^-64 of it, with the same bits in any order.
  Rng rng(11);
  for (const double range : {1.0, 20.0, 150.0, 300.0}) {
    std::vector<double> terms;
    long double reference = 0;
    double largest = 0;
    for (int i = 0; i < 1000; ++i) {
      const double x = (rng.uniform() - 0.5) * std::pow(10.0, range * (2 * rng.uniform() - 1));
      terms.push_back(x);
      largest = std::max(largest, std::abs(x));
    }
    ExactSum forward;
    for (const double x : terms)
      forward.add(x), reference += static_cast<long double>(x);
    CHECK(std::abs(forward.value() - static_cast<double>(reference)) <= 1e-15 * 1000 * largest);
    ExactSum backward, left, right, parts;
    for (std::size_t i = terms.size(); i-- > 0;)
      backward.add(terms[i]);
    for (std::size_t i = 0; i < terms.size(); ++i)
      (i % 3 == 0 ? left : right).add(terms[i]);
    parts.add(left), parts.add(right);
    ExactSum turned = right;
    turned.add(left);
    CHECK(backward == forward);
    CHECK(parts == forward);
    CHECK(turned == forward);
  }
}

TEST_CASE("A film holds every finite radiance, with its standard error") {
  for (const double scale : {1e-40, 1e-20, 1.0, 1e15, 1e38}) {
    Film film(1, 1, 1);
    for (const double v : {1.0, 2.0, 4.0, 5.0})
      film.add_block(0, 0, {v * scale, 1, 0});
    CHECK(std::abs(film.mean(0, 0, 0) / scale - 3) <= 1e-14);
    CHECK(std::abs(film.variance(0, 0, 0) / (scale * scale) - 10.0 / 12) <= 1e-12);
    CHECK(film.mean(0, 0, 1) == 1);
    CHECK(film.mean(0, 0, 2) == 0);
  }
}

TEST_CASE("Impossible films are refused") {
  CHECK_THROWS_AS(Film(0, 4, 1), Error);
  CHECK_THROWS_AS(Film(4, -1, 1), Error);
  CHECK_THROWS_AS(Film(100000, 100000, 1), Error);
  CHECK_THROWS_AS(Film(2, 2, 1).merge(Film(2, 3, 1)), Error);
  CHECK_THROWS_AS(Film(2, 2, 1).merge(Film(2, 2, 2)), Error);
}

Image random_image(int width, int height, std::uint64_t seed) {
  Rng rng(seed);
  Image image(width, height);
  for (Rgb& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c)
      pixel[c] = rng.uniform_float();
  }
  return image;
}

TEST_CASE("An EXR round trip keeps every bit, the errors and the attributes") {
  const TemporaryFolder scratch;
  ExrFile file{random_image(17, 5, 1), random_image(17, 5, 2), {{"seed", "18446744073709551615"}}};
  file.image.at(3, 2) = Rgb(1e-20f, 1e20f, std::numeric_limits<float>::infinity());
  write_exr(scratch.path() / "a.exr", file);
  const ExrFile back = read_exr(scratch.path() / "a.exr");
  CHECK(back.image.pixels == file.image.pixels);
  REQUIRE(back.standard_error);
  CHECK(back.standard_error->pixels == file.standard_error->pixels);
  CHECK(back.attributes == file.attributes);
  write_exr(scratch.path() / "b.exr", file);
  CHECK(read_file(scratch.path() / "a.exr") == read_file(scratch.path() / "b.exr"));
}

TEST_CASE("An EXR header that claims what the file does not hold is refused unread") {
  using Catch::Matchers::ContainsSubstring;
  const TemporaryFolder scratch;
  const auto path = scratch.path() / "a.exr";
  write_exr(path, {random_image(2, 2, 1), {}, {{"seed", "1"}}});
  const std::string good = read_file(path);
  const auto with_bit = [&](std::size_t place, int bit) {
    std::string bytes = good;
    bytes[place] = static_cast<char>(bytes[place] ^ bit);
    write_file(path, bytes);
  };
  // An attribute is its name, its type, the value's size in four bytes, the value.
  for (const std::string type : {"string", "box2i", "chlist", "v2f"}) {
    const std::size_t size = good.find('\0' + type + '\0') + type.size() + 2;
    with_bit(size + 3, 0x40);
    CHECK_THROWS_WITH(read_exr(path), ContainsSubstring("are left"));
    if (type == "string") continue;  // of any length
    with_bit(size, 0x01);
    CHECK_THROWS_WITH(read_exr(path), ContainsSubstring("expected"));
  }
}

TEST_CASE("An EXR's size is one that its bytes can unpack to") {
  using Catch::Matchers::ContainsSubstring;
  const TemporaryFolder scratch;
  const auto path = scratch.path() / "a.exr";
  write_exr(path, {Image(640, 480), {}, {}});
  CHECK(read_exr(path).image.pixels.size() == 640 * 480);
  write_exr(path, {random_image(2, 2, 1), {}, {}});
  std::string bytes = read_file(path);
  // The third of the four numbers is the last column.
  const std::string before = std::string("dataWindow") + '\0' + "box2i" + '\0';
  bytes[bytes.find(before) + before.size() + 4 + 8 + 2] = 1;
  write_file(path, bytes);
  CHECK_THROWS_WITH(read_exr(path),
                    ContainsSubstring("65538 x 2 pixels of 3 channels cannot come"));
}

TEST_CASE("Of an EXR's counts those are read that are asked for and there") {
  const TemporaryFolder scratch;
  const auto path = scratch.path() / "a.exr";
  const std::map<std::string, std::vector<std::uint32_t>> counts{
      {"sums.a", {1, 2}}, {"sums.b", {3, 4}}, {"sums.c", {5, 0xFFFFFFFF}}};
  write_exr(path, {random_image(2, 1, 1), {}, {}, counts});
  CHECK(read_exr(path).counts.empty());
  const auto back = read_exr(path, {"sums.c", "R", "sums.a", "none"}).counts;
  CHECK(back.size() == 2);
  CHECK(back.at("sums.a") == counts.at("sums.a"));
  CHECK(back.at("sums.c") == counts.at("sums.c"));
  CHECK(read_exr(path, {"sums.b"}).counts.at("sums.b") == counts.at("sums.b"));
}

TEST_CASE("An EXR's numbers of samples are floats, which every program reads as they are") {
  const TemporaryFolder scratch;
  const auto path = scratch.path() / "a.exr";
  ExrFile file{random_image(2, 1, 1), random_image(2, 1, 2), {}, {{"sums.a", {1, 0xFFFFFFFF}}}};
  file.samples = {8, 16};
  write_exr(path, file);
  const std::string of_floats = std::string("samples") + '\0' + '\2';
  CHECK(read_file(path).find(of_floats) != std::string::npos);
  const ExrFile back = read_exr(path, {"sums.a"});
  CHECK(back.image.pixels == file.image.pixels);
  CHECK(back.standard_error.value().pixels == file.standard_error->pixels);
  CHECK(back.counts == file.counts);
}

TEST_CASE("What cannot be read or written is an error that leaves nothing behind") {
  const TemporaryFolder scratch;
  write_file(scratch.path() / "not.exr", "hello");
  using Catch::Matchers::ContainsSubstring;
  CHECK_THROWS_WITH(read_exr(scratch.path() / "not.exr"), ContainsSubstring("as OpenEXR"));
  CHECK_THROWS_AS(read_exr(scratch.path() / "missing.exr"), Error);
  // A PNG is no reference: its values are not linear.
  write_png(scratch.path() / "a.png", Image(2, 2));
  CHECK_THROWS_WITH(read_exr(scratch.path() / "a.png"), ContainsSubstring("as OpenEXR"));
  const Image image(2, 2);
  CHECK_THROWS_AS(write_exr(scratch.path() / "no" / "such.exr", {image, {}, {}}), Error);
  CHECK_THROWS_AS(write_png(scratch.path() / "no" / "such.png", image), Error);
  { const AtomicFile unfinished(scratch.path() / "x.png"); }
  CHECK(std::distance(fs::directory_iterator(scratch.path()), {}) == 2);
}

TEST_CASE("Writing through a link keeps the link and replaces what it points to") {
  const TemporaryFolder scratch;
  write_file(scratch.path() / "real", "old");
  fs::create_symlink("real", scratch.path() / "link");
  write_file(scratch.path() / "link", "new");
  CHECK(fs::is_symlink(scratch.path() / "link"));
  CHECK(read_file(scratch.path() / "real") == "new");
}

TEST_CASE("A file is read whole, however long it is; a folder is an error") {
  const TemporaryFolder scratch;
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 1000000u}) {
    std::string text(size, 'a');
    for (std::size_t i = 0; i < size; ++i)
      text[i] = static_cast<char>(i * i % 251);
    write_file(scratch.path() / "file", text);
    CHECK(read_file(scratch.path() / "file") == text);
  }
  CHECK_THROWS_AS(read_file(scratch.path()), Error);
  CHECK_THROWS_AS(read_file(scratch.path() / "nowhere"), Error);
}

TEST_CASE("A PNG is written whole and has its signature") {
  const TemporaryFolder scratch;
  write_png(scratch.path() / "a.png", random_image(8, 8, 1));
  CHECK(read_file(scratch.path() / "a.png").substr(1, 3) == "PNG");
}

TEST_CASE("Errors against a reference are the definitions'") {
  Image a(2, 1), r(2, 1);
  a.pixels = {Rgb(1), Rgb(3)};
  r.pixels = {Rgb(1), Rgb(2)};
  const ImageError error = compare(a, r);
  CHECK(std::abs(error.mse - 0.5) <= 1e-12);
  CHECK(std::abs(error.rel_mse - 0.5 / 4.01) <= 1e-12);
  CHECK(error.mean[0] == 2);
  CHECK_THROWS_AS(compare(a, Image(1, 1)), Error);
  a.pixels[0].r = std::numeric_limits<float>::quiet_NaN();
  CHECK(std::isnan(compare(a, r).mse));
  CHECK(count_non_finite(a) == 1);
}

TEST_CASE("Bias z-scores of unbiased noise are standard normal, and a bias of 5 sd shows") {
  // 200 images of 32x32 with unit noise per pixel: the variance of 600 z has sd .058.
  double sum = 0;
  const Image zero(32, 32);
  Image se(32, 32);
  for (Rgb& p : se.pixels)
    p = Rgb(1 / std::sqrt(12.0f));
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Image noise = random_image(32, 32, seed);
    for (Rgb& p : noise.pixels)
      p -= Rgb(0.5f);
    for (const double z : bias_z(noise, se, zero, zero))
      sum += z * z;
  }
  CHECK(std::abs(sum / 600 - 1) <= 5 * 0.058);
  Image biased = zero;
  for (Rgb& p : biased.pixels)
    p = Rgb(5 / std::sqrt(12.0f) / 32);
  CHECK(std::abs(bias_z(biased, se, zero, zero)[0] - 5) <= 1e-3);
  CHECK(tile_z(biased, se, zero, zero, 16).size() == 4 * 3);
}

TEST_CASE("Sums survive as words, negative ones too") {
  for (const double x : {0.0, 1.0, -1.0, 1e20, -3e25, 0x1p111, -0x1p111, 5e-324, -1e-45, 1e300}) {
    ExactSum sum;
    sum.add(x);
    CHECK(ExactSum::from_words(sum.words()) == sum);
    CHECK(sum.value() == x);
  }
}

}  // namespace
