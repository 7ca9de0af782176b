// The verb slides: the lecture, made by Marp (slides/tool).

#include "course/verbs/course.h"
#include "support/atomic_file.h"

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

std::string text_of(const fs::path& file) {
  return fs::exists(file) ? read_file(file) : "";
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

void install_marp(const fs::path& root) {
  const fs::path folder = root / "build/slides", lock = root / "slides/package-lock.json",
                 installed = folder / "node_modules/.installed";
  const std::string wanted = read_file(lock);
  if (text_of(installed) == wanted) return;
  say({"carlo: installing Marp ...\n"});
  fs::create_directories(folder);
  for (const char* name : {"package.json", "package-lock.json"})
    fs::copy_file(root / "slides" / name, folder / name, fs::copy_options::overwrite_existing);
  std::string said;
  const int code =
      run_gathering(list_of({"bash", "-c", R"(cd "$0" && exec "$@")", folder, "npm", "ci",
                             "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"}),
                    {}, said);
  if (code != 0) {
    say({said});
    fail({"npm could not install Marp"});
  }
  write_file(installed, wanted);
}

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
  if (decks) {
    tree.need({"npm"});
    install_marp(tree.root);
  }
  throw HandOver{(command += {wishes.mode, bin}) += wishes.decks};
}

static const Verb slides_verb("slides", slides);

}  // namespace carlo::verbs
