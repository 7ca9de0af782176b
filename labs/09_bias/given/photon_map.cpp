#include "given/photon_map.h"

#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <span>

namespace lab09 {
namespace {

constexpr std::size_t longest_leaf = 8;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// A place on its way into the tree, and the photon that it belongs to.
struct Loose {
  PhotonMap::Place place;
  std::uint32_t photon;
};

/// The axis along which the places spread most.
int widest_axis(std::span<const Loose> range) {
  Vec3 low = range.front().place.p, high = low;
  for (const Loose& loose : range) {
    low = glm::min(low, loose.place.p);
    high = glm::max(high, loose.place.p);
  }
  const Vec3 spread = high - low;
  if (spread.x >= spread.y && spread.x >= spread.z) return 0;
  return spread.y >= spread.z ? 1 : 2;
}

void build(std::span<Loose> range) {
  while (range.size() > longest_leaf) {
    const int axis = widest_axis(range);
    const std::size_t middle = range.size() / 2;
    std::nth_element(
        range.begin(), range.begin() + static_cast<std::ptrdiff_t>(middle), range.end(),
        [axis](const Loose& a, const Loose& b) { return a.place.p[axis] < b.place.p[axis]; });
    range[middle].place.axis = static_cast<std::uint32_t>(axis);
    build(range.first(middle));
    range = range.subspan(middle + 1);
  }
}

void check(Vec3 p) {
  if (glm::all(glm::lessThan(glm::abs(p), Vec3(infinity)))) return;
  throw carlo::Error(fmt::format("a photon lies nowhere: its place is ({:g}, {:g}, {:g})",
                                 static_cast<double>(p.x), static_cast<double>(p.y),
                                 static_cast<double>(p.z)));
}

/// Searches a tree and calls found(index, distance2) for each place nearer to p than the limit;
/// found() returns the square of the new limit.
template <class Found>
class Search {
 public:
  Search(std::span<const PhotonMap::Place> places, Vec3 p, float limit2, Found found)
      : places_(places), p_(p), limit2_(limit2), found_(std::move(found)) {
    visit(0, places.size());
  }

 private:
  void visit(std::size_t first, std::size_t last) {
    while (last - first > longest_leaf) {
      const std::size_t middle = first + (last - first) / 2;
      const PhotonMap::Place& node = places_[middle];
      const auto axis = static_cast<int>(node.axis);
      const float away = p_[axis] - node.p[axis];
      const bool below = away < 0;
      if (below) {
        visit(first, middle);
        first = middle + 1;
      } else {
        visit(middle + 1, last);
        last = middle;
      }
      // Rounding is monotonic: nothing on the other side has a rounded distance below this.
      if (!(away * away < limit2_)) return;
      test(middle);
    }
    for (std::size_t i = first; i < last; ++i)
      test(i);
  }

  void test(std::size_t i) {
    const Vec3 d = places_[i].p - p_;
    const float distance2 = d.x * d.x + d.y * d.y + d.z * d.z;
    if (distance2 < limit2_) limit2_ = found_(i, distance2);
  }

  std::span<const PhotonMap::Place> places_;
  Vec3 p_;
  float limit2_;
  Found found_;
};

/// The nearest so far. Collects twice as many as wanted before the far ones are dropped, all at
/// once.
class Nearest {
 public:
  explicit Nearest(std::size_t wanted) : wanted_(wanted) { found_.reserve(2 * wanted); }

  float add(std::size_t index, float distance2) {
    found_.push_back({distance2, index});
    if (found_.size() == 2 * wanted_) drop_far();
    return limit2_;
  }

  std::vector<std::size_t> in_order() {
    drop_far();
    std::sort(found_.begin(), found_.end(), nearer);
    std::vector<std::size_t> indices;
    indices.reserve(found_.size());
    for (const Found& found : found_)
      indices.push_back(found.index);
    return indices;
  }

 private:
  struct Found {
    float distance2;
    std::size_t index;
  };
  static bool nearer(const Found& a, const Found& b) { return a.distance2 < b.distance2; }

  void drop_far() {
    if (found_.size() < wanted_) return;
    const auto last = found_.begin() + static_cast<std::ptrdiff_t>(wanted_ - 1);
    std::nth_element(found_.begin(), last, found_.end(), nearer);
    limit2_ = last->distance2;
    found_.resize(wanted_);
  }

  std::size_t wanted_;
  float limit2_ = infinity;
  std::vector<Found> found_;
};

}  // namespace

PhotonMap::PhotonMap(std::vector<Photon> photons, float scale) {
  std::vector<Loose> range;
  range.reserve(photons.size());
  for (Photon& photon : photons) {
    check(photon.p);
    photon.flux *= scale;
    range.push_back({{photon.p, 0}, static_cast<std::uint32_t>(range.size())});
  }
  build(range);
  places_.reserve(range.size());
  photons_.reserve(range.size());
  for (const Loose& loose : range) {
    places_.push_back(loose.place);
    photons_.push_back(photons[loose.photon]);
  }
}

void PhotonMap::within(Vec3 p, float radius,
                       const std::function<void(const Photon&, float distance2)>& use) const {
  if (!(radius > 0)) return;
  const float limit2 = radius * radius;
  Search(places_, p, limit2, [&](std::size_t i, float distance2) {
    use(photons_[i], distance2);
    return limit2;
  });
}

std::vector<const Photon*> PhotonMap::nearest(Vec3 p, int k) const {
  if (k <= 0 || size() == 0) return {};
  Nearest nearest(std::min(static_cast<std::size_t>(k), size()));
  Search(places_, p, infinity,
         [&](std::size_t i, float distance2) { return nearest.add(i, distance2); });
  std::vector<const Photon*> photons;
  for (const std::size_t i : nearest.in_order())
    photons.push_back(&photons_[i]);
  return photons;
}

}  // namespace lab09
