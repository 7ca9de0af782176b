// The verbs slides and site: the lecture, made by Marp (slides/tool), and the course in a browser
// (slides/site).

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

static int site(Course& course, const Words& words) {
  const Tree& tree = course.tree;
  std::filesystem::path out = tree.root / "out/site";
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (asks_for_help(words[i])) {
      tree.print_help("site");
      return 0;
    }
    if (words[i] != "-o") unknown("site", words[i]);
    out = std::filesystem::absolute(value_behind(words, i, "site"));
  }
  tree.need({"node", "site"});
  install_packages(tree, "slides", "build/slides", "Marp");
  course.building.build(list_of({"carlo_site_native", "carlo_slide_plot", "carlo_render"}));
  throw HandOver{
      list_of({"node", tree.root / "slides/site/site.mjs", course.building.folder() / "bin", out})};
}

static const Verb site_verb("site", site);

}  // namespace carlo::verbs
