#include "course/report/chart.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "importance.h"
#include "pictures.h"
#include "power_family.h"

#include <fmt/core.h>

#include <cmath>
#include <vector>

// f, p and f/p, and the effect of p on the variance.

namespace lab06 {
namespace {

struct Member {
  double n;
  std::string title;
};

std::vector<Member> members() {
  return {{0, "uniform"},
          {3, "close to f"},
          {4, "proportional to f"},
          {7, "too far"},
          {14, "too thin"}};
}

carlo::Cell variance_cell(double n) {
  const double variance = power_variance(n);
  return std::isfinite(variance) ? carlo::Cell(variance) : carlo::Cell("infinite", variance);
}

std::string picture(std::string_view title, std::string_view note, const Density& p) {
  const View view{0, 1, 6};
  std::vector<double> marks;
  for (int i = 0; i < 40; ++i)
    marks.push_back(p.sample((i + 0.5) / 40));
  const auto ratio = [&](double x) { return p.pdf(x) > 0 ? power_f(x) / p.pdf(x) : NAN; };
  return graph_picture(title, note, view,
                       {line("f", "c1", view, power_f), line("p", "c2", view, p.pdf),
                        line("f/p", "c3", view, ratio)},
                       marks);
}

void member_table(Notebook& notebook) {
  const std::int64_t n = notebook.options().n;
  carlo::Table table({"p", "N", "estimate", "standard error", "error", "variance", "theory",
                      "time a sample", "efficiency"},
                     {"p", "points", "estimate", "standard_error", "error", "variance",
                      "variance_theory", "seconds", "efficiency"});
  for (const Member& member : members()) {
    const Density p = power_density(member.n);
    carlo::Rng rng = notebook.rng();
    const Estimate e = summarize(contributions(power_f, p, n, rng));
    const std::int64_t draws = n / 8;
    const double seconds =
        best_seconds([&] { return contributions(power_f, p, draws, rng).back(); }) /
        static_cast<double>(draws);
    const double worth = efficiency(e.variance, seconds);
    // The rounding error of a variance of 0 would give a meaningless number.
    const bool exact = e.variance < 1e-20;
    table.add_row({fmt::format("x^{:g}, {}", member.n, member.title), n, e.value, e.standard_error,
                   std::abs(e.value - 1), e.variance, variance_cell(member.n),
                   carlo::seconds_cell(seconds),
                   exact ? carlo::Cell("(infinite)") : carlo::Cell(worth)});
  }
  notebook.table("shapes", table,
                 "∫ 5x⁴ = 1; efficiency is 1/(variance × time of one sample), in 1/s");
}

void variance_chart(Notebook& notebook) {
  carlo::Series theory{"closed form", {}}, measured{"measured", {}};
  for (int i = 0; i <= 17; ++i) {
    const double n = i / 2.0;
    theory.points.push_back({n, power_variance(n)});
  }
  const std::int64_t count = notebook.options().n / 4;
  for (int i = 0; i <= 17; ++i) {
    const double n = i / 2.0;
    carlo::Rng rng = notebook.rng();
    measured.points.push_back(
        {n, summarize(contributions(power_f, power_density(n), count, rng)).variance});
  }
  notebook.say(
      "From n = 17/3 on the mean of (f/p)⁴ is infinite, and with it the variance of a measured "
      "variance: it depends on the few largest samples. Most runs fall short of the closed form, and "
      "a standard error that comes of such a variance is too small.");
  notebook.charts({{"Variance along the family p as x^n",
                    "zero at n = 4, where p is proportional to f; infinite from n = 9 on",
                    {"n", carlo::Unit::number, carlo::Scale::linear},
                    {"variance of one sample", carlo::Unit::number, carlo::Scale::linear},
                    {theory, measured}}});
}

}  // namespace

void shapes_experiment(Notebook& notebook) {
  notebook.begin("f, p and f/p");
  notebook.say(
      "f = 5x⁴, as a glossy highlight that peaks at x = 1, with integral 1; p runs through the "
      "densities (n + 1)xⁿ. What is averaged is f/p, so what matters is how flat f/p is, and not "
      "only where the points are: the strokes on the axis are forty of them.");
  std::vector<std::string> pictures;
  for (const Member& member : members())
    pictures.push_back(
        picture(member.title, fmt::format("p as x^{:g}", member.n), power_density(member.n)));
  pictures.push_back(picture("does not cover f", "p uniform on [1/2, 1)", uniform_density(0.5, 1)));
  notebook.raw_html(carlo::tiles(pictures, 18));
  notebook.raw_html(family_slider());
  notebook.script(carlo::slider_script());
  notebook.attempt([&] { member_table(notebook); });
  notebook.progress(1, 2);
  notebook.attempt([&] { variance_chart(notebook); });
}

}  // namespace lab06
