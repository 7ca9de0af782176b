// Checks of exercise 6.6. All exact: given pairs, and identities.

#include "06_importance/inputs.h"
#include "06_importance/match.h"
#include "06_importance/theory.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace carlo::grader;
using namespace lab06_tests;

namespace {

const Diagnosis counts_ignored{"numbers-of-samples-ignored",
                               "the weight depends on samples x pdf, not on the pdf alone."};
const Diagnosis not_squared{"power-without-squares", "the power heuristic squares the products."};
const Diagnosis pdf_squared{
    "only-the-pdf-squared",
    "the power heuristic squares the products, the numbers of samples too."};
const Diagnosis balance_squared{"balance-with-squares",
                                "the balance heuristic does not square the products."};
const Diagnosis weight_of_other{"weight-of-the-other", "own's product is the numerator."};
const Diagnosis weight_zero_by_zero{"zero-by-zero",
                                    "where own's product is 0 the weight is 0, not 0/0."};
const Diagnosis overflow{"overflow",
                         "a square, product or sum leaves the range of double: divide first."};

using Weight = std::function<double(const Pair&)>;

/// Of a weight from the products' logarithms, which reach 709.
constexpr double rounding = 1e-11;

/// The right weight, from the ratio of the products.
double right_weight(const Pair& pair, int e) {
  if (!(pair.samples > 0 && pair.pdf > 0)) return 0;
  if (!(pair.other_samples > 0 && pair.other_pdf > 0)) return 1;
  const double ratio = pair.other_pdf / pair.pdf * (pair.other_samples / pair.samples);
  return 1 / (1 + std::pow(ratio, e));
}

bool tame(const Pair& pair) {
  const double own = pair.samples * pair.pdf, other = pair.other_samples * pair.other_pdf;
  return own > 0 && other > 0 && own < 1e100 && other < 1e100 && own > 1e-100 && other > 1e-100;
}

/// Reports the first pair whose weight is wrong; names a mistake if all tame pairs agree with it,
/// and division by zero or overflow if only their pairs are wrong.
void judge_weights(const std::string& what, const std::vector<double>& measured, int e,
                   bool exchanged) {
  std::vector<Pair> all = pairs();
  if (exchanged) {
    for (Pair& p : all)
      p = {p.other_samples, p.other_pdf, p.samples, p.pdf};
  }
  const std::vector<std::pair<Weight, Diagnosis>> mistakes = {
      {[&](const Pair& p) {
         return right_weight({1, p.pdf, 1, p.other_pdf}, e);
       },
       counts_ignored},
      {[&](const Pair& p) {
         return right_weight({p.other_samples, p.other_pdf, p.samples, p.pdf}, e);
       },
       weight_of_other},
      {[&](const Pair& p) { return right_weight(p, 3 - e); },
       e == 2 ? not_squared : balance_squared},
      {[&](const Pair& p) {
         const double own = p.samples * p.pdf * p.pdf;
         return own / (own + p.other_samples * p.other_pdf * p.other_pdf);
       },
       pdf_squared}};
  std::vector<bool> fits(mistakes.size(), true);
  std::vector<Diagnosis> diagnoses;
  std::size_t first_wrong = all.size();
  bool zero_wrong = false, wild_wrong = false, tame_wrong = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool wrong = !agrees(measured[i], right_weight(all[i], e), rounding, 1e-30);
    if (wrong && first_wrong == all.size()) first_wrong = i;
    const bool none = all[i].samples * all[i].pdf == 0;
    zero_wrong = zero_wrong || (wrong && none);
    wild_wrong = wild_wrong || (wrong && !none && !tame(all[i]));
    tame_wrong = tame_wrong || (wrong && tame(all[i]));
    for (std::size_t m = 0; tame(all[i]) && m < mistakes.size(); ++m)
      fits[m] = fits[m] && agrees(measured[i], mistakes[m].first(all[i]), 1e-9);
  }
  if (first_wrong == all.size()) {
    judge(holds(what, true, "right for all pairs", "right for all pairs"));
    return;
  }
  for (std::size_t m = 0; m < mistakes.size() && tame_wrong; ++m) {
    if (fits[m]) diagnoses.push_back(mistakes[m].second);
  }
  if (!tame_wrong && zero_wrong) diagnoses.push_back(weight_zero_by_zero);
  if (!tame_wrong && wild_wrong) diagnoses.push_back(overflow);
  const Pair& p = all[first_wrong];
  judge(holds(fmt::format("{} of {:g} x {:g} against {:g} x {:g}", what, p.samples, p.pdf,
                          p.other_samples, p.other_pdf),
              false, fmt::format("{:.12g}", measured[first_wrong]),
              fmt::format("{:.12g}", right_weight(p, e)), diagnoses));
}

}  // namespace

TEST_CASE("Lab 6.6: the weights of given pairs, zeros and huge pdfs among them", "[lab06][ex6]") {
  const Rows rows =
      probe("Lab 6.6 weights", {}, {.rows = pairs().size(), .columns = 4, .finite = false});
  for (const int e : {1, 2}) {
    const char* const name = e == 1 ? "the balance weight" : "the power weight";
    const auto first = static_cast<std::size_t>(2 * e - 2);
    judge_weights(name, column(rows, first), e, false);
    judge_weights(name, column(rows, first + 1), e, true);
  }
}

TEST_CASE("Lab 6.6: own's and other's weights add up to 1 over the whole range of double",
          "[lab06][ex6]") {
  constexpr std::size_t n = 20'000;
  const Rows rows = probe("Lab 6.6 sums", {.n = n}, {.rows = n, .columns = 4, .finite = false});
  const char* const names[] = {"balance", "power"};
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    double bad = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double weight = rows.at(i, 2 * k), sum = rows.at(i, 2 * k + 1);
      bad += weight >= 0 && weight <= 1 && std::abs(sum - 1) <= 1e-14 ? 0 : 1;
    }
    judge(holds(fmt::format("pairs of {} weights outside [0, 1] or not adding up to 1", names[k]),
                bad == 0, fmt::format("{:g} of {}", bad, n), "none"));
  }
}
