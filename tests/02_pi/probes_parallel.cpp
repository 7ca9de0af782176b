// Probes of exercise 2.6: samplers that record who calls them, and when.

#include "02_pi/reference.h"
#include "course/not_implemented.h"
#include "grader/worker/probe.h"
#include "pi.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

using carlo::grader::RowWriter;
using lab02::chunk_samples;
using lab02::Sums;
using lab02_tests::number;

namespace {

/// How long a sampler waits for what must happen. A right solution needs far less, even on a busy
/// machine; a wrong one waits in vain.
constexpr std::chrono::seconds patience{2};

std::int64_t chunks_of(std::int64_t n) {
  return (n + chunk_samples - 1) / chunk_samples;
}

/// The chunk whose generator this is, unused so far; -1 if it belongs to none of the first
/// `chunks`. Draws from it, so that a generator that is handed out again is recognised.
std::int64_t chunk_of(carlo::Rng& rng, std::uint64_t seed, std::int64_t chunks) {
  const std::uint64_t word = rng.next_u64();
  for (std::int64_t i = 0; i < chunks; ++i) {
    if (carlo::Rng(seed, static_cast<std::uint64_t>(i)).next_u64() == word) return i;
  }
  return -1;
}

/// Counts the threads inside at the same time, and lets threads wait for each other.
class Watch {
 public:
  void enter() {
    const std::lock_guard lock(mutex_);
    ++inside_;
    ++calls_;
    most_ = std::max(most_, inside_);
    changed_.notify_all();
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    --inside_;
    ++left_;
    changed_.notify_all();
  }
  /// Waits until `most` were inside at once, or `left` have left; false if patience ends first.
  bool wait_for_most(std::int64_t most) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return most_ >= most; });
  }
  bool wait_for_left(std::int64_t left) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return left_ >= left; });
  }

  double inside() { return locked(inside_); }
  double calls() { return locked(calls_); }
  double most() { return locked(most_); }

 private:
  double locked(const std::int64_t& value) {
    const std::lock_guard lock(mutex_);
    return number(value);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t inside_ = 0, calls_ = 0, left_ = 0, most_ = 0;
};

/// Calls enter() now and leave() at the end of the scope, however it ends.
class Inside {
 public:
  explicit Inside(Watch& watch) : watch_(watch) { watch_.enter(); }
  ~Inside() { watch_.leave(); }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  Watch& watch_;
};

}  // namespace

PROBE("Lab 2.6 sums", "count", "sum", "squares") {
  const auto sampler = [](std::int64_t n, carlo::Rng& rng) {
    const auto [count, sum, squares] = lab02_tests::sample(n, rng);
    return Sums{count, sum, squares};
  };
  const Sums sums = lab02::sum_in_parallel(sampler, params.n, params.seed,
                                           static_cast<int>(params.whole("threads")));
  return {3, {number(sums.count), sums.sum, sums.squares}};
}

// One row per chunk: how often its generator was handed out, with how many samples in all. The last
// row is for generators that belong to no chunk.
PROBE("Lab 2.6 chunks", "times taken", "samples") {
  const std::int64_t chunks = chunks_of(params.n);
  std::mutex mutex;
  std::vector<Sums> seen(static_cast<std::size_t>(chunks + 1));
  const auto watching = [&](std::int64_t n, carlo::Rng& rng) {
    const std::int64_t chunk = chunk_of(rng, params.seed, chunks);
    const std::lock_guard lock(mutex);
    Sums& entry = seen[static_cast<std::size_t>(chunk < 0 ? chunks : chunk)];
    ++entry.count;
    entry.sum += number(n);
    return Sums{n, 0, 0};
  };
  (void)lab02::sum_in_parallel(watching, params.n, params.seed,
                               static_cast<int>(params.whole("threads")));
  RowWriter rows;
  for (const Sums& entry : seen)
    rows.add({number(entry.count), entry.sum});
  return rows.take();
}

// The first chunk ends only after all others, which takes a free thread; its sum is so large that
// the others vanish unless they were added up before it. The others wait until two are inside, so
// that a thread that starts late does not count as missing.
PROBE("Lab 2.6 slow chunk", "others were done first", "sum", "most at once", "first chunk taken",
      "chunks taken") {
  Watch watch;
  std::atomic<bool> others_done = false, alone = false;
  std::atomic<int> firsts = 0;
  const std::int64_t chunks = chunks_of(params.n);
  const auto sampler = [&](std::int64_t n, carlo::Rng& rng) {
    const Inside inside(watch);
    const bool first = chunk_of(rng, params.seed, 1) == 0;
    if (first) {
      ++firsts;
      others_done = watch.wait_for_left(chunks - 1);
    } else if (!alone) {
      alone = !watch.wait_for_most(2);
    }
    return Sums{n, first ? 1e18 : 50, 0};
  };
  const Sums sums = lab02::sum_in_parallel(sampler, params.n, params.seed, 2);
  return {5, {others_done ? 1.0 : 0.0, sums.sum, watch.most(), number(firsts), watch.calls()}};
}

PROBE("Lab 2.6 together", "most at once") {
  Watch watch;
  const auto threads = params.whole("threads");
  const auto sampler = [&](std::int64_t n, carlo::Rng&) {
    const Inside inside(watch);
    if (watch.calls() <= number(threads)) (void)watch.wait_for_most(threads);
    return Sums{n, 0, 0};
  };
  (void)lab02::sum_in_parallel(sampler, params.n, params.seed, static_cast<int>(threads));
  return {1, {watch.most()}};
}

// {the fate of the exception: 0 lost, 1 replaced, 2 the one thrown; samplers still running; calls
// of the sampler; whether the failing chunk was sampled}
PROBE("Lab 2.6 failure", "exception that arrived", "still running", "calls of the sampler",
      "the chunk failed") {
  Watch watch;
  const std::int64_t failing = params.whole("chunk");
  const bool plain = params.whole("plain") != 0;
  std::atomic<bool> failed = false;
  const auto sampler = [&](std::int64_t n, carlo::Rng& rng) {
    const Inside inside(watch);
    const std::int64_t chunk = chunk_of(rng, params.seed, failing + 2);
    if (chunk == failing) {
      failed = true;
      if (plain) throw 42;
      throw std::domain_error("a sample went wrong");
    }
    if (chunk == failing + 1) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return Sums{n, 0, 0};
  };
  double outcome = 0;
  try {
    (void)lab02::sum_in_parallel(sampler, params.n, params.seed,
                                 static_cast<int>(params.whole("threads")));
  } catch (const carlo::NotImplemented&) {
    throw;
  } catch (const std::domain_error& error) {
    outcome = std::string_view(error.what()) == "a sample went wrong" ? 2 : 1;
  } catch (int number) {
    outcome = plain && number == 42 ? 2 : 1;
  } catch (...) {
    outcome = 1;
  }
  return {4, {outcome, watch.inside(), watch.calls(), failed ? 1.0 : 0.0}};
}
