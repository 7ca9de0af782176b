// The yardstick of build.sh: a machine that takes twice as long for this takes twice as long for
// builds. Only headers, templates and code of the standard library, so that no change of ours
// affects it.

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <ranges>
#include <regex>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace {

template <class T>
std::size_t sorted_places(std::vector<T> values) {
  std::map<T, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < values.size(); ++i)
    places[values[i]].push_back(i);
  std::stable_sort(values.begin(), values.end(), std::greater<>());
  std::size_t sum = places.size();
  for (const T& value : values | std::views::take(3))
    sum += places.at(value).front();
  return sum;
}

template <std::size_t size>
std::size_t shuffled(std::mt19937_64& random) {
  std::vector<std::tuple<double, std::string, int>> rows(size);
  for (auto& [key, name, count] : rows) {
    key = std::normal_distribution<double>()(random);
    count = std::poisson_distribution<int>(static_cast<double>(size))(random);
    name = std::to_string(key);
  }
  std::shuffle(rows.begin(), rows.end(), random);
  return sorted_places(rows);
}

}  // namespace

int main(int argc, char** argv) {
  std::mt19937_64 random(static_cast<unsigned long>(argc));
  std::unordered_map<std::string, std::size_t> lengths;
  const std::regex pattern("([a-z]+)/([0-9]+)");
  for (const std::string text : std::vector<std::string>(argv, argv + argc)) {
    std::smatch match;
    if (std::regex_search(text, match, pattern)) lengths[match.str(1)] += text.size();
    lengths[std::filesystem::path(text).filename().string()] += 1;
  }
  std::cout << lengths.size() + sorted_places<int>({3, 1, 2}) +
                   sorted_places<std::string>({"b", "a"}) + shuffled<8>(random) +
                   shuffled<64>(random)
            << '\n';
}
