// The verb site: the course in a browser, made by slides/site.

#include "course/verbs/course.h"

#include <filesystem>
#include <string>

namespace carlo::verbs {

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
