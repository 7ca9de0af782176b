// `./carlo test --hard`: prints the table of hard cases. Exit code 0 if all bounds hold.

#include "course/cli/main_guard.h"
#include "hard_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

int main() {
  return carlo::run_main([] {
    std::vector<hard_cases::HardCase> cases;
    for (const auto family :
         {hard_cases::number_cases, hard_cases::light_cases, hard_cases::geometry_cases,
          hard_cases::lobe_cases, hard_cases::path_cases}) {
      for (auto& c : family())
        cases.push_back(std::move(c));
    }
    std::sort(cases.begin(), cases.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    fmt::print("{:>2}  {:<41}  {:<23}  {:<24}  {:<23}\n", "#", "case", "naive", "ours", "bound");
    int broken = 0;
    for (const auto& c : cases) {
      fmt::print("{:>2}  {:<41}  {:<23}  {:<24}  {:<23}{}\n", c.number, c.name, c.naive, c.ours,
                 c.bound, c.holds ? "" : "  DOES NOT HOLD");
      broken += c.holds ? 0 : 1;
    }
    fmt::print("{} cases, {}\n", cases.size(),
               broken == 0 ? "all bounds hold" : fmt::format("{} do not hold", broken));
    return broken == 0 ? 0 : 1;
  });
}
