// Checks of the weights of exercise 8.8: the power heuristic and the density of light points, both
// exact.

#include "08_path_tracer/theory.h"

#include <functional>
#include <vector>

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis sums_not_squares{"balance-heuristic",
                                 "this is the balance heuristic: the power heuristic squares."};
const Diagnosis squares_overflow{
    "squares-overflow",
    "p^2 and q^2 overflow, or vanish, where p and q are large or small: "
    "square their ratio."};
const Diagnosis light_choice{"light-choice-not-in-pdf",
                             "one of several lights is chosen: the density includes its chance()."};
const Diagnosis no_cosine{"cosine-missing-in-light-pdf",
                          "distance^2/(cos area): the cosine at the light is missing."};
const Diagnosis no_distance_in_pdf{"distance-missing-in-light-pdf",
                                   "distance^2/(cos area): the squared distance is missing."};
const Diagnosis no_area_in_pdf{"area-missing-in-light-pdf",
                               "distance^2/(cos area): the light's area is missing."};
const Diagnosis times_area{"light-pdf-times-area",
                           "a larger light has a smaller density at each of its points: divide by "
                           "its area."};
const Diagnosis per_area{"light-pdf-per-area",
                         "1/area is the density per area. Multiply by distance^2/cos to get the "
                         "density per solid angle."};
const Diagnosis turned_over{"light-pdf-inverted",
                            "the conversion from area to solid angle is inverted: the density "
                            "grows where the same area covers less solid angle."};

}  // namespace

TEST_CASE("Lab 8.8: the power heuristic", "[lab08][ex8]") {
  const double huge = HUGE_VAL;
  struct Case {
    double p, q, weight;
  };
  for (const Case& c : {Case{1, 1, 0.5},
                        {3, 1, 0.9},
                        {1, 3, 0.1},
                        {2, 0, 1},
                        {0, 2, 0},
                        {1e25, 1e25, 0.5},
                        {1e-25, 3e-25, 0.1},
                        {1, huge, 0},
                        {1e30, 1, 1}}) {
    const Rows rows =
        probe("Lab 8.8 heuristic", {.numbers = {{"p", c.p}, {"q", std::isinf(c.q) ? -1 : c.q}}},
              {.finite = false, .of = fmt::format("p = {:g}, q = {:g}", c.p, c.q)});
    const bool extreme = c.p > 1e20 || (c.p < 1e-20 && c.p > 0) || c.q > 1e20;
    Suspects suspects;
    if (c.p != c.q && c.p > 0 && c.q > 0 && !std::isinf(c.q))
      suspects.push_back({c.p / (c.p + c.q), sums_not_squares});
    Verdict verdict = equals(fmt::format("the weight of {:g} beside {:g}", c.p, c.q), rows.at(0, 0),
                             c.weight, 1e-6, suspects);
    if (!verdict.passed && extreme && verdict.diagnoses.empty())
      verdict.diagnoses.push_back(squares_overflow);
    judge(verdict);
  }
}

TEST_CASE("Lab 8.8: the density of light points", "[lab08][ex8]") {
  for (const Light light : {Light::rectangle, Light::sphere, Light::two}) {
    const Rows rows =
        probe("Lab 8.8 light pdf", {.numbers = {{"light", static_cast<double>(light)}}},
              {.rows = 40, .columns = 5, .of = name_of(light)});
    double wrong = 0, lit = 0;
    // The density due to each mistake, and the number of values that match it.
    struct Other {
      std::function<double(double d2, double cosine, double area, double chance)> factor;
      Diagnosis diagnosis;
      double fits = 0;
    };
    std::vector<Other> others = {
        {[](double, double cosine, double, double) { return cosine; }, no_cosine},
        {[](double d2, double, double, double) { return 1 / d2; }, no_distance_in_pdf},
        {[](double d2, double cosine, double, double) { return cosine / d2; }, per_area},
        {[](double d2, double cosine, double, double) { return cosine * cosine / d2 / d2; },
         turned_over},
        {[](double d2, double cosine, double area, double chance) {
           return std::pow(cosine * area / (d2 * chance), 2);
         },
         turned_over}};
    if (light == Light::two) {
      others.push_back(
          {[](double, double, double, double chance) { return 1 / chance; }, light_choice});
    }
    if (light != Light::rectangle) {
      others.push_back({[](double, double, double area, double) { return area; }, no_area_in_pdf});
      others.push_back(
          {[](double, double, double area, double) { return area * area; }, times_area});
    }
    for (std::size_t i = 0; i < rows.count(); ++i) {
      const double d2 = rows.at(i, 1), cosine = rows.at(i, 2), area = rows.at(i, 3);
      const double exact = area == 0 ? 0 : d2 * rows.at(i, 4) / (cosine * area);
      const auto is = [&](double value) {
        return std::abs(rows.at(i, 0) - value) <= 1e-4 * std::abs(value) ? 1 : 0;
      };
      wrong += 1 - is(exact);
      lit += area > 0 ? 1 : 0;
      if (area == 0) continue;
      for (Other& other : others)
        other.fits += is(exact * other.factor(d2, cosine, area, rows.at(i, 4)));
    }
    std::vector<Diagnosis> diagnoses;
    for (const Other& other : others) {
      if (other.fits == lit) diagnoses.push_back(other.diagnosis);
    }
    judge(holds(fmt::format("light_pdf, {}", light == Light::two      ? "two lights"
                                             : light == Light::sphere ? "a ball"
                                                                      : "a square light"),
                wrong == 0 && lit > 0, fmt::format("{:g} of {} differ", wrong, rows.count()),
                "distance^2 chance/(cos area); 0 for what does not emit", diagnoses));
  }
}
