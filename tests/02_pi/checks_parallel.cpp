// Checks of exercise 2.6. All are exact: the result of a parallel sum must not depend on luck.

#include "02_pi/reference.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

using namespace carlo::grader;
using lab02_tests::Streams;

namespace {

constexpr double chunk = 1 << 14;  // chunk_samples of the contract

const Diagnosis order{"added-up-as-they-finish",
                      "the sums differ in their last bits: floating-point addition depends on the "
                      "order. Keep each chunk's result and add them up in the order of the chunks, "
                      "after all threads have ended."};
const Diagnosis wrong_streams{"generators-not-of-the-chunks",
                              "a chunk's random numbers must come from carlo::Rng(seed, chunk), "
                              "whoever works on it."};
const Diagnosis same_stream{"one-stream-for-all-chunks",
                            "every chunk gets the same random numbers: the samples repeat."};
const Diagnosis wrong_sizes{"samples-not-n",
                            "the chunks hold more or fewer than n samples in all: look at the last "
                            "one."};
const Diagnosis left_out{"sums-not-complete",
                         "count, sum and squares of the parts must all be added up: one of them "
                         "is not."};
const Diagnosis lost_parts{"parts-lost",
                           "the sum is complete with one thread, but not with several: threads "
                           "that add to one variable without a lock overwrite each other. Keep "
                           "each chunk's result and add them up after all threads have ended."};
const Diagnosis too_few{
    "threads-not-at-the-same-time",
    "fewer samplers than threads run at the same time: is each thread joined before the next one "
    "starts, is a lock held while sampling, or are there never more threads than the machine has "
    "cores?"};
const Diagnosis too_many{"too-many-threads", "more samplers run at once than `threads` allows."};
const Diagnosis fixed_shares{"fixed-shares",
                             "a thread that is free does not take over chunks that nobody has "
                             "begun: one slow chunk delays those assigned to the same thread."};
const Diagnosis swallowed{"exception-lost",
                          "the sampler threw, but the caller got no exception: an incomplete sum "
                          "was returned."};
const Diagnosis other_exception{"exception-replaced",
                                "an exception arrived, but not the one that the sampler threw: "
                                "std::exception_ptr keeps it as it is."};
const Diagnosis left_running{"threads-left-running",
                             "a sampler still runs after the function has ended."};
const Diagnosis continues{"works-on-after-a-failure",
                          "further chunks are begun although one has failed already."};
const Diagnosis race{"data-race",
                     "two threads that take a chunk at the same moment get the same one: reading "
                     "the number of the next chunk and advancing it must be one indivisible step "
                     "(one ++ of a std::atomic, or a lock around both)."};

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// True if the sums are so close that only their order can differ. `alone`: they were right with
/// one thread.
bool judge_sums(double n, double threads, bool alone) {
  const auto whole = static_cast<std::int64_t>(n);
  const Answer rows =
      probe("Lab 2.6 sums", {.n = whole, .numbers = {{"threads", threads}}}, {.columns = 3});
  const auto totals = lab02_tests::totals_by_chunks(whole, rows.seed);
  const auto repeated = lab02_tests::totals_by_chunks(whole, rows.seed, Streams::the_first);
  const std::string of =
      fmt::format(" of {}, {}", counted(n, "sample"), counted(threads, "thread"));
  const auto of_parts = [&](double measured, double expected, const Diagnosis& otherwise) {
    if (measured == 0) return left_out;
    if (!alone) return otherwise;
    return measured > expected ? race : lost_parts;
  };
  judge(holds("the count" + of, rows.at(0, 0) == n, number_in_report(rows.at(0, 0)),
              number_in_report(n), {of_parts(rows.at(0, 0), n, wrong_sizes)}));
  if (rows.at(0, 0) != n) return false;
  const auto near = [](double measured, double expected) {
    return std::abs(measured - expected) <= 1e-9 * expected;
  };
  const double sum = rows.at(0, 1), squares = rows.at(0, 2);
  const bool close = near(sum, totals.sum) && near(squares, totals.squares);
  // Both must match: one sample more may hardly change one of them.
  const bool again = near(sum, repeated.sum) && near(squares, repeated.squares);
  const auto judge_one = [&](const char* what, double measured, double expected) {
    judge(holds(
        what + of, same_bits(measured, expected), fmt::format("{:.17g}", measured),
        fmt::format("{:.17g}, to the last bit", expected),
        {close ? order : (again ? same_stream : of_parts(measured, expected, wrong_streams))}));
  };
  judge_one("the sum", sum, totals.sum);
  judge_one("the sum of squares", squares, totals.squares);
  return close;
}

struct Handed {
  double samples = 0;
  double strays = 0;
  std::size_t right = 0, wrong = 0;
  bool only_first = false;  ///< all chunks got chunk 0's generator
  bool repeated = false;    ///< some chunks were sampled more than once, but none partly
};

Handed handed_out(const Rows& rows, double n) {
  Handed handed;
  const std::size_t chunks = rows.count() - 1;
  bool whole = true, again = false;
  for (std::size_t i = 0; i < chunks; ++i) {
    const double size = std::min(chunk, n - chunk * static_cast<double>(i));
    const double times = rows.at(i, 0), samples = rows.at(i, 1);
    ++(times == 1 && samples == size ? handed.right : handed.wrong);
    handed.samples += samples;
    again = again || times > 1;
    whole = whole && samples == times * size;
  }
  handed.strays = rows.at(chunks, 0);
  handed.samples += rows.at(chunks, 1);
  const bool begun_only = handed.strays == 0;
  handed.only_first = begun_only && chunks > 1 && rows.at(0, 0) == static_cast<double>(chunks);
  handed.repeated = begun_only && whole && again && !handed.only_first;
  return handed;
}

void judge_chunks(double n, double threads) {
  const auto chunks = static_cast<std::size_t>(std::ceil(n / chunk));
  const Rows rows = probe("Lab 2.6 chunks",
                          {.n = static_cast<std::int64_t>(n), .numbers = {{"threads", threads}}},
                          {.rows = chunks + 1, .columns = 2});
  const Handed handed = handed_out(rows, n);
  // The counter may race here too, not only where threads are made to meet.
  const Diagnosis& uneven = threads > 1 && handed.repeated ? race : wrong_sizes;
  judge(holds(fmt::format("the samples handed out for n = {}, {}", number_in_report(n),
                          counted(threads, "thread")),
              handed.samples == n, number_in_report(handed.samples), number_in_report(n),
              {uneven}));
  judge(
      holds("each chunk's generator, once, with the chunk's samples",
            handed.wrong == 0 && handed.strays == 0,
            fmt::format("{} as they should be, {} not, {} of no chunk",
                        counted(static_cast<double>(handed.right), "chunk"), handed.wrong,
                        counted(handed.strays, "generator")),
            fmt::format("all {} as they should be", counted(static_cast<double>(chunks), "chunk")),
            {handed.only_first ? same_stream : (handed.strays > 0 ? wrong_streams : uneven)}));
}

/// `plain`: throws an int, which is no class of exceptions.
void judge_failure(double threads, double chunks, double failing, bool plain = false) {
  const Rows rows =
      probe("Lab 2.6 failure",
            {.n = static_cast<std::int64_t>(chunks * chunk),
             .numbers = {{"threads", threads}, {"chunk", failing}, {"plain", plain ? 1.0 : 0.0}}},
            {.columns = 4});
  const double outcome = rows.at(0, 0);
  // A sampler that never gets the failing chunk's generator does not throw.
  const bool failed = rows.at(0, 3) == 1;
  const auto of_failure = [&](const Diagnosis& diagnosis) {
    return failed ? std::vector{diagnosis} : std::vector<Diagnosis>{};
  };
  const std::string of = fmt::format(", {}, chunk {:g} throws{}", counted(threads, "thread"),
                                     failing, plain ? " 42" : "");
  judge(holds("the exception that reaches the caller" + of, outcome == 2,
              outcome == 0 ? "none" : (outcome == 1 ? "another one" : "the sampler's"),
              "the sampler's", of_failure(outcome == 0 ? swallowed : other_exception)));
  judge(holds("samplers still running afterwards" + of, rows.at(0, 1) == 0,
              number_in_report(rows.at(0, 1)), "none", {left_running}));
  // Before the failure is known to them, other threads may begin a chunk or two; not a hundred.
  const double allowed = threads == 1 ? failing + 1 : failing + 1 + 100 * threads;
  judge(holds("calls of the sampler" + of, rows.at(0, 2) <= allowed,
              number_in_report(rows.at(0, 2)), "at most " + number_in_report(allowed),
              of_failure(continues)));
}

}  // namespace

TEST_CASE("Lab 2.6: the sums have the same bits for any number of threads", "[lab02][ex6]") {
  const bool alone = judge_sums(20 * chunk + 123, 1, false);
  for (const double threads : {2.0, 3.0, 8.0})
    judge_sums(20 * chunk + 123, threads, alone);
}

TEST_CASE("Lab 2.6: no samples, one sample, one chunk and more threads than chunks",
          "[lab02][ex6]") {
  for (const double n : {0.0, 1.0, chunk - 1, chunk, chunk + 1}) {
    const bool alone = judge_sums(n, 1, false);
    judge_sums(n, 5, alone);
  }
}

TEST_CASE("Lab 2.6: every chunk is sampled once, with its own generator", "[lab02][ex6]") {
  judge_chunks(30 * chunk + 1, 1);
  judge_chunks(30 * chunk + 1, 4);
  judge_chunks(30 * chunk, 4);
}

// One thread is stopped at every instruction between two of its chunks until another one has taken
// a chunk (stepping.h), so that a counter that can race does, on any machine.
TEST_CASE("Lab 2.6: threads that take a chunk at the same moment take different ones",
          "[lab02][ex6]") {
  constexpr double chunks = 20'000;
  const Rows rows = probe("Lab 2.6 meeting", {.numbers = {{"threads", 3}, {"chunks", chunks}}},
                          {.rows = static_cast<std::size_t>(chunks) + 1});
  const double strays = rows.values.back();
  const auto twice = std::count_if(rows.values.begin(), rows.values.end() - 1,
                                   [](double count) { return count > 1; });
  const auto never = std::count(rows.values.begin(), rows.values.end() - 1, 0.0);
  std::vector<Diagnosis> diagnoses;
  if (strays > 0) diagnoses = {wrong_streams};
  if (rows.values.front() == chunks) diagnoses = {same_stream};
  if (diagnoses.empty() && twice > 0) diagnoses = {race};
  judge(
      holds(fmt::format("{}, taken by threads that meet", counted(chunks, "chunk")),
            twice == 0 && never == 0 && strays == 0,
            fmt::format("{} taken twice or more, {} never, {} of no chunk",
                        number_in_report(static_cast<double>(twice)),
                        number_in_report(static_cast<double>(never)), counted(strays, "generator")),
            "each taken once", diagnoses));
}

// The samplers wait for each other: with three threads, three are inside at once.
TEST_CASE("Lab 2.6: as many samplers run at once as there are threads, and no more",
          "[lab02][ex6]") {
  const Rows rows =
      probe("Lab 2.6 together",
            {.n = static_cast<std::int64_t>(12 * chunk), .numbers = {{"threads", 3}}}, {});
  const double most = rows.at(0, 0);
  judge(holds("the most samplers at once, of 3 threads", most == 3, number_in_report(most), "3",
              {most < 3 ? too_few : too_many}));
}

// With two threads: the first chunk ends only after all others, and its sum absorbs whatever is
// added to it, so that exactly 1e18 is left if chunk 0 comes first.
TEST_CASE("Lab 2.6: a slow chunk holds up nobody, and is still added first", "[lab02][ex6]") {
  constexpr double chunks = 8;
  const Rows rows =
      probe("Lab 2.6 slow chunk", {.n = static_cast<std::int64_t>(chunks * chunk)}, {.columns = 5});
  const bool together = rows.at(0, 2) == 2;
  // The first may wait in vain for chunks that nobody took, or that were given the first's
  // generator again.
  const bool each_once = rows.at(0, 3) == 1 && rows.at(0, 4) == chunks;
  std::vector<Diagnosis> diagnoses;
  if (!together)
    diagnoses = {too_few};
  else if (each_once)
    diagnoses = {fixed_shares};
  judge(holds("while the first chunk waits", rows.at(0, 0) == 1,
              rows.at(0, 0) == 1 ? "the other thread does all others" : "other chunks wait too",
              "the other thread does all others", diagnoses));
  // A larger deviation is not due to the order: other chunks were treated as the first.
  const bool near = std::abs(rows.at(0, 1) - 1e18) <= 1e6;
  judge(holds("the sum, with the largest first", rows.at(0, 1) == 1e18,
              fmt::format("{:.17g}", rows.at(0, 1)), "1e18",
              near ? std::vector{order} : std::vector<Diagnosis>{}));
}

TEST_CASE("Lab 2.6: an exception of the sampler reaches the caller", "[lab02][ex6]") {
  judge_failure(1, 20, 0);
  judge_failure(1, 20, 7);
  judge_failure(4, 20, 0);
  judge_failure(4, 20, 19);
  judge_failure(2, 20, 7, true);
}

TEST_CASE("Lab 2.6: after an exception no further chunk is begun", "[lab02][ex6]") {
  judge_failure(2, 200'000, 3);
}
