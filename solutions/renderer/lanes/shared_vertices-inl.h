// The first two vertices of paths that pixels share. Included once for each instruction set.

#if defined(CARLO_SHARED_VERTICES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SHARED_VERTICES_INL
#undef CARLO_SHARED_VERTICES_INL
#else
#define CARLO_SHARED_VERTICES_INL
#endif

#include "renderer/lanes/steps-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Numbers of up to `most_shared` paths, in columns: a cache line longer, since all columns would
/// compete for the same lines of the cache if they began at multiples of a large power of two (a
/// quarter of the time).
constexpr std::size_t most_shared = 1 << 12;
using Column = std::array<float, most_shared + 16>;
using Column3 = std::array<Column, 3>;

HWY_INLINE V load(const Column& column, std::size_t slot) {
  return hn::Load(d_, column.data() + slot);
}
HWY_INLINE U load_word(const Column& column, std::size_t slot) {
  return hn::BitCast(du_, load(column, slot));
}
HWY_INLINE V3 load(const Column3& c, std::size_t slot) {
  return {load(c[0], slot), load(c[1], slot), load(c[2], slot)};
}
HWY_INLINE void store(Column& column, std::size_t slot, V v) {
  hn::Store(v, d_, column.data() + slot);
}
HWY_INLINE void store(Column& column, std::size_t slot, U u) {
  hn::Store(hn::BitCast(d_, u), d_, column.data() + slot);
}
HWY_INLINE void store(Column3& c, std::size_t slot, V3 v) {
  store(c[0], slot, v.x), store(c[1], slot, v.y), store(c[2], slot, v.z);
}

/// The first vertices of paths, by Paths::number.
struct FirstVertices {
  alignas(64) Column3 p, arrival;
  alignas(64) Column3 n, flat_n;  ///< to shade with; the triangle's, in scenes with vertex normals
  alignas(64) Column3 clear;      ///< Origins::clear, in scenes with meshes
  alignas(64) Column3 k, L;       ///< reflectance, and what the path found so far
  alignas(64) Column q, per_q;    ///< probability to go on; one over it, or 0 if the path ended
  alignas(64) Column last, plane, there;
};

/// The second vertices of paths, by Paths::number.
class SecondVertices {
 public:
  explicit SecondVertices(const LaneScene& scene) : meshes_(scene.meshes != nullptr) {}

  alignas(64) Column3 p, n;   ///< with the normal on the path's side
  alignas(64) Column3 clear;  ///< Origins::clear, in scenes with meshes
  alignas(64) Column3 L;      ///< what the path found before it left this vertex
  alignas(64) Column plane;   ///< Origins::starts_on()
  alignas(64) Column there;   ///< 1, or 0 if the path has no such vertex

  V3 n_of_first;  ///< the geometric normals at the first vertices of the paths that are there

  /// Notes the vertices of those paths that leave their second one, which then begin to gather
  /// light anew.
  template <class Needs>
  HWY_INLINE void note(Paths& paths, V3 normal) {
    const M here = hn::And(same(paths.depth, set_word(2)), paths.alive);
    if (hn::AllFalse(d_, here)) return;
    const ToFront front(here);
    std::size_t column = 0;
    const auto put = [&](V v)
                         HWY_ATTR { hn::StoreU(front(v), d_, queue_[column++].data() + queued_); };
    put(paths.from.o.x), put(paths.from.o.y), put(paths.from.o.z);
    put(normal.x), put(normal.y), put(normal.z);
    put(paths.L.x), put(paths.L.y), put(paths.L.z);
    put(hn::BitCast(d_, paths.from.template starts_on<Needs::close>()));
    put(hn::BitCast(d_, paths.number));
    if constexpr (Needs::full)
      put(paths.from.clear.x), put(paths.from.clear.y), put(paths.from.clear.z);
    queued_ += hn::CountTrue(d_, here);
    paths.L = select(here, set(0, 0, 0), paths.L);
    if (queued_ > queue_length) put_in_place();
  }

  /// To be called before the columns are read.
  void put_in_place() {
    for (std::size_t i = 0; i < queued_; ++i) {
      const auto number = std::bit_cast<std::uint32_t>(queue_[10][i]);
      for (std::size_t c = 0; c < 3; ++c) {
        p[c][number] = queue_[c][i];
        n[c][number] = queue_[3 + c][i];
        L[c][number] = queue_[6 + c][i];
        if (meshes_) clear[c][number] = queue_[11 + c][i];
      }
      plane[number] = queue_[9][i];
      there[number] = 1;
    }
    queued_ = 0;
  }

 private:
  static constexpr std::size_t queue_length = 128;
  std::array<std::array<float, queue_length + 2 * lanes>, 14> queue_;
  std::size_t queued_ = 0;
  bool meshes_;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SHARED_VERTICES_INL
