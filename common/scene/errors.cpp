#include "scene/errors.h"

#include <algorithm>
#include <string_view>
#include <tuple>

namespace carlo {

void SceneErrors::raise() const {
  if (errors_.empty()) return;
  constexpr std::size_t most = 50;
  const auto key = [&](const PlacedError& e) {
    const auto file = std::find(files_.begin(), files_.end(), e.file()) - files_.begin();
    return std::tuple(file, e.line(), e.column(), std::string_view(e.what()));
  };
  std::vector<PlacedError> sorted = errors_;
  std::sort(sorted.begin(), sorted.end(),
            [&](const PlacedError& a, const PlacedError& b) { return key(a) < key(b); });
  const auto same = [&](const PlacedError& a, const PlacedError& b) { return key(a) == key(b); };
  sorted.erase(std::unique(sorted.begin(), sorted.end(), same), sorted.end());
  if (sorted.size() > most) {
    const PlacedError& next = sorted[most];
    const PlacedError rest(next.file(), next.line(), next.column(),
                           fmt::format("and {} more errors", sorted.size() - most));
    sorted.erase(sorted.begin() + most, sorted.end());
    sorted.push_back(rest);
  }
  const PlacedError& first = sorted.front();
  std::string text = first.message();
  for (auto next = sorted.begin() + 1; next != sorted.end(); ++next)
    text += std::string("\n") + next->what();
  throw PlacedError(first.file(), first.line(), first.column(), text);
}

}  // namespace carlo
