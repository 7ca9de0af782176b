// carlo_site_native scenes: prints the scenes that the pages can trace, as JSON.
// carlo_site_native: answers calls, NAME NUMBER... on a line of stdin each, by a line of numbers.

#include "course/cli/main_guard.h"
#include "course/cli/source_folder.h"
#include "images/views.h"
#include "scene/load_scene.h"
#include "scenes.h"
#include "support/error.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <iostream>
#include <sstream>

namespace {

/// All digits, also of infinities and NaN.
std::string in_words(const site::Numbers& numbers, const char* between) {
  return fmt::format("{}", fmt::join(numbers, between));
}

void print_scenes() {
  fmt::print("{{\"room with balls\":[{}],\n\"plates\":[{}]",
             in_words(site::numbers_of(lab08::room_with_balls()), ","),
             in_words(site::numbers_of(lab08::plates()), ","));
  for (const char* name :
       {"cornell_lambert", "cornell_phong", "soft_shadows", "indirect", "caustics", "furnace"}) {
    const carlo::Scene scene =
        carlo::load_scene(carlo::source_folder() / "common/scenes" / fmt::format("{}.xml", name));
    fmt::print(",\n\"{}\":[{}]", name, in_words(site::numbers_of(scene), ","));
  }
  fmt::print("}}\n");
}

void answer(const std::string& line) {
  std::istringstream words(line);
  std::string name;
  words >> name;
  site::Numbers arguments;
  for (std::string word; words >> word;)
    arguments.push_back(std::stod(word));
  fmt::print("{}\n", in_words(site::Function::call(name, arguments), " "));
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    if (argc > 1 && std::string(argv[1]) == "scenes") {
      print_scenes();
      return 0;
    }
    for (std::string line; std::getline(std::cin, line);)
      answer(line);
    return 0;
  });
}
