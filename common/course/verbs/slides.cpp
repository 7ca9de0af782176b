// The verb slides: the lecture, made by Marp (slides/tool).

#include "course/verbs/course.h"

#include <fmt/core.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <system_error>

namespace carlo::verbs {
namespace {

namespace fs = std::filesystem;

struct SlidesWishes {
  std::string mode = "pdf";
  Words decks;
  bool help = false;
};

/// True if `word` names a deck: 4, 04 or 4a.
bool is_deck(const std::string& word) {
  const bool letter = !word.empty() && word.back() >= 'a' && word.back() <= 'z';
  return is_number(letter ? word.substr(0, word.size() - 1) : word, 2);
}

SlidesWishes slides_wishes(const Words& words) {
  SlidesWishes wishes;
  for (const std::string& word : words) {
    if (asks_for_help(word)) {
      wishes.help = true;
      return wishes;
    }
    if (is_one_of(word, {"--html", "--watch", "--check", "--run", "--remake", "--pictures"})) {
      if (wishes.mode != "pdf")
        fail({"slides does one thing at a time: --", wishes.mode, " or ", word});
      wishes.mode = word.substr(2);
    } else if (word[0] == '-') {
      unknown("slides", word);
    } else if (!is_deck(word)) {
      fail({"a deck is a number such as 4, got '", word, "'"});
    } else {
      wishes.decks.push_back(word);
    }
  }
  return wishes;
}

/// Returns the programs that draw the decks' figures.
Words programs_of(const Words& tool, const std::string& bin, const SlidesWishes& wishes) {
  Words command = tool;
  std::istringstream names(output_of((command += {"programs", bin, wishes.mode}) += wishes.decks));
  Words programs;
  for (std::string name; names >> name;)
    programs.push_back(name);
  return programs;
}

}  // namespace

static int slides(Course& course, const Words& words) {
  const SlidesWishes wishes = slides_wishes(words);
  if (wishes.help) {
    course.tree.print_help("slides");
    return 0;
  }
  const Tree& tree = course.tree;
  const Words tool = list_of({"node", tree.root / "slides/tool/slides.mjs"});
  const std::string bin = course.building.folder() / "bin";
  Words command = tool;
  tree.need({"node"});
  if (wishes.mode == "check") throw HandOver{command += {"check", bin}};
  const Words programs = programs_of(tool, bin, wishes);
  if (!programs.empty()) course.building.build(programs);
  const bool decks = is_one_of(wishes.mode, {"pdf", "html", "watch"});
  if (is_one_of(wishes.mode, {"pdf", "pictures"})) tree.need({"chromium"});
  if (decks) install_packages(tree, "slides", "build/slides", "Marp");
  throw HandOver{(command += {wishes.mode, bin}) += wishes.decks};
}

static const Verb slides_verb("slides", slides);

}  // namespace carlo::verbs
