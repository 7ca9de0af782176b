// The probe of exercise 2.6 that makes threads meet where they take a chunk.

#include "02_pi/stepping.h"
#include "grader/worker/probe.h"
#include "pi.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <unordered_map>
#include <vector>

using carlo::grader::RowWriter;
using lab02::Sums;

namespace {

namespace stepping = lab02_tests::stepping;
using namespace std::chrono_literals;

constexpr int passages = 4;

/// Maps the first word of each chunk's generator to the chunk.
std::unordered_map<std::uint64_t, std::size_t> chunks_by_word(std::uint64_t seed,
                                                              std::size_t count) {
  std::unordered_map<std::uint64_t, std::size_t> chunks;
  for (std::size_t i = 0; i < count; ++i)
    chunks.emplace(carlo::Rng(seed, i).next_u64(), i);
  return chunks;
}

/// The first thread is single-stepped from the end of one chunk to the beginning of the next, a few
/// times; meanwhile the others take chunks.
class Meeting {
 public:
  void chunk_begins() {
    stepping::end_here();
    const std::thread::id self = std::this_thread::get_id();
    if (nobody_.exchange(false)) led_ = self;
    if (led_ != self) stepping::went_on();
  }
  void chunk_ends() {
    if (led_ != std::this_thread::get_id()) {
      others_ = true;
      // Chunks should last as long as these passages.
      if (passage_ <= passages) std::this_thread::sleep_for(1us);
      return;
    }
    if (passage_ == 0) await_others();
    if (++passage_ <= passages) stepping::begin_here();
  }

 private:
  /// Waits no longer than any machine takes to start a thread.
  void await_others() const {
    const auto end = std::chrono::steady_clock::now() + 500ms;
    while (!others_ && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(100us);
  }

  std::atomic<bool> nobody_ = true, others_ = false;
  std::atomic<std::thread::id> led_{};
  std::atomic<int> passage_ = 0;
};

}  // namespace

// One row per chunk: how often its generator was handed out. The last row is for generators of no
// chunk.
PROBE("Lab 2.6 meeting", "times taken") {
  const auto chunks = static_cast<std::size_t>(params.whole("chunks"));
  const auto by_word = chunks_by_word(params.seed, chunks);
  std::vector<std::atomic<int>> seen(chunks + 1);
  Meeting meeting;
  stepping::prepare();
  const auto sampler = [&](std::int64_t n, carlo::Rng& rng) {
    meeting.chunk_begins();
    const auto found = by_word.find(rng.next_u64());
    ++seen[found == by_word.end() ? chunks : found->second];
    meeting.chunk_ends();
    return Sums{n, 0, 0};
  };
  (void)lab02::sum_in_parallel(sampler, static_cast<std::int64_t>(chunks) * lab02::chunk_samples,
                               params.seed, static_cast<int>(params.whole("threads")));
  RowWriter rows;
  for (const std::atomic<int>& count : seen)
    rows.add({static_cast<double>(count)});
  return rows.take();
}
