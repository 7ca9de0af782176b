#pragma once

// Shared by the checks of Labs 5.4 to 5.6, draws from tables.

#include "05_inversion_rejection/inputs.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lab05_tests {

inline const carlo::grader::Diagnosis spent{
    "u-used-twice",
    "u was used for the choice: what remains is its relative position between the two CDF "
    "entries, not u itself."};
inline const carlo::grader::Diagnosis accepts_nonsense{
    "bad-weights-accepted",
    "weights that cannot be probabilities have to be rejected with carlo::Error."};
inline const carlo::grader::Diagnosis no_width{
    "probability-for-density",
    "this is the probability of a bin or cell; its density is the probability "
    "divided by its width or area."};
inline const carlo::grader::Diagnosis slips{
    "slips-into-the-neighbour",
    "rounding moves some x across the edge into a bin of density 0: use the functions of bins.h "
    "to place x and to look up bins."};

inline const carlo::grader::Diagnosis next_bin{
    "neighbouring-bin",
    "this is the result for the bin next to it: bin i, counted from 0, extends from i/n to (i + "
    "1)/n."};

inline double number(std::size_t i) {
  return static_cast<double>(i);
}

/// The right result for u in a table of weights.
struct Place {
  double index, fraction, before;
};

inline Place place_of(double u, const std::vector<double>& cdf) {
  const auto above = std::upper_bound(cdf.begin(), cdf.end(), u);
  const double before = above == cdf.begin() ? 0 : *(above - 1);
  return {number(static_cast<std::size_t>(above - cdf.begin())), (u - before) / (*above - before),
          before};
}

/// True if u is so near an edge that rounding decides.
inline bool near_edge(double u, const std::vector<double>& cdf) {
  const auto above = std::lower_bound(cdf.begin(), cdf.end(), u - 1e-12);
  return above != cdf.end() && std::abs(*above - u) <= 1e-12 && u < 1 - 1e-12;
}

/// True if u is at the edge of its bin: only there may rounding give a sample of density 0.
inline bool at_edge(double u, const std::vector<double>& cdf) {
  const double fraction = place_of(u, cdf).fraction;
  return std::min(fraction, 1 - fraction) <= 1e-6;
}

inline carlo::grader::Params params_of(Weights kind) {
  return {.numbers = {{"weights", static_cast<double>(kind)}}};
}

inline const char* name_of(Weights kind) {
  constexpr std::array names{"the weights 1 2 3 2",
                             "the weights 0 0 1 0 2 0 0 1 0",
                             "a single weight",
                             "the weights 1e-310 0 3e-310",
                             "300 rugged weights",
                             "131072 weights, every second 0",
                             "six equal weights and two zeros",
                             "the weights 8e-17 1.168 0.183",
                             "the weights 3 1e-8 2 1e-5 5"};
  return names.at(static_cast<std::size_t>(kind));
}

/// Edges of the CDF are compared only where they are exact in double.
inline bool exact_edges(Weights kind) {
  return kind == Weights::eighths || kind == Weights::gaps || kind == Weights::comb ||
         kind == Weights::one;
}

/// The weights over their sum.
inline std::vector<double> probabilities(const std::vector<double>& weights) {
  long double sum = 0;
  for (const double weight : weights)
    sum += weight;
  std::vector<double> result;
  result.reserve(weights.size());
  for (const double weight : weights)
    result.push_back(static_cast<double>(weight / sum));
  return result;
}

/// `named`: whether the diagnosis is that the weights are accepted, and not another mistake.
inline void judge_refusal(const char* probe_name, const char* name, int kind, bool named = true) {
  const carlo::grader::Rows rows =
      carlo::grader::probe(probe_name, {.numbers = {{"kind", kind}}}, {.of = name});
  const double answer = rows.at(0, 0);
  carlo::grader::judge(carlo::grader::is_so(
      name, answer == 1, answer == 0 ? "accepted" : "an exception of another kind", "carlo::Error",
      named ? std::vector{accepts_nonsense} : std::vector<carlo::grader::Diagnosis>{}));
}

}  // namespace lab05_tests
