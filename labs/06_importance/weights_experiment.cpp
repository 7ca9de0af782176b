#include "experiments.h"
#include "importance.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

// Weights where pdfs are extreme: small lights have large ones, mirrors infinite ones.

namespace lab06 {
namespace {

/// The power heuristic as in textbooks, in float, the type of a renderer's pdfs.
float textbook_in_float(float own, float other) {
  return own * own / (own * own + other * other);
}

std::string short_number(double x) {
  if (std::isnan(x)) return "NaN";
  return std::isinf(x) ? "infinite" : fmt::format("{:g}", x);
}

}  // namespace

void weights_experiment(Notebook& notebook) {
  notebook.begin("Weights of extreme pdfs");
  constexpr std::array<std::array<double, 2>, 9> pdfs = {{{2, 1},
                                                          {0, 3},
                                                          {0, 0},
                                                          {1e-25, 3e-25},
                                                          {1e20, 1},
                                                          {1e20, 3e20},
                                                          {1e30, 1e30},
                                                          {1e200, 3e200},
                                                          {INFINITY, 1}}};
  carlo::Table table({"own pdf", "other's pdf", "textbook, float", "balance", "power"},
                     {"own", "other", "textbook_float", "balance", "power"});
  const bool done = notebook.attempt([&] {
    for (const auto& [own, other] : pdfs) {
      const float naive = textbook_in_float(static_cast<float>(own), static_cast<float>(other));
      table.add_row({short_number(own), short_number(other), short_number(naive),
                     balance_weight({1, own}, {1, other}), power_weight({1, own}, {1, other})});
    }
  });
  if (!done) return;
  notebook.say(
      "The lobe of a good mirror, a light that is all but a point, or the product of the pdfs "
      "along a path leave the range in which a float can be squared, 1e-23 to 1.8e19, sooner "
      "than one thinks. The textbook's formula gives NaN there, and the pixel is ruined. The "
      "ratio of the two products does not: where it overflows, the weight is 0 anyway.");
  notebook.table("weights", table, "Weights of own's sample, one sample each");
}

}  // namespace lab06
