#include "grader/grade/recipe.h"

#include "grader/judge/process.h"
#include "support/error.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

std::string ninja_program() {
  for (const char* path : {"/usr/bin/ninja", "/usr/local/bin/ninja", "/bin/ninja"}) {
    if (::access(path, X_OK) == 0) return path;
  }
  throw Error("ninja was not found: ./carlo setup installs it");
}

std::string ninja_commands(const fs::path& build, const std::string& target) {
  Limits limits;
  limits.deadline = std::chrono::seconds(60);
  limits.memory_bytes = limits.file_bytes = limits.output_kept = unlimited;
  limits.output_bytes = std::size_t{256} << 20;
  Command command{{ninja_program(), "-C", build.string(), "-t", "commands", target}, {}};
  const Outcome outcome = run_limited(command, limits);
  if (!outcome.succeeded()) {
    throw Error("{}: ninja does not know {}: build the graders first ({})", build.string(), target,
                outcome.output.substr(0, outcome.output.find('\n')));
  }
  return outcome.output;
}

/// Returns the word after `flag`, or "".
std::string after(const std::vector<std::string>& words, const std::string& flag) {
  const auto found = std::find(words.begin(), words.end(), flag);
  return found == words.end() || std::next(found) == words.end() ? "" : *std::next(found);
}

/// Parses the compile command. Words before the compiler are a launcher such as ccache.
void read_compile(const std::vector<std::string>& words, Recipe& recipe) {
  auto word = std::find(words.begin(), words.end(), recipe.compiler);
  if (word == words.end()) throw Error("the compiler is not the one that links: {}", words.front());
  for (++word; word != words.end(); ++word) {
    if (*word == "-o" || *word == "-c" || *word == "-MT" || *word == "-MF") {
      ++word;
      if (word == words.end()) break;
    } else if (*word == "-isystem" && std::next(word) != words.end()) {
      recipe.includes.emplace_back(*++word);
    } else if (word->starts_with("-I")) {
      recipe.includes.emplace_back(word->substr(2));
    } else if (*word != "-MD") {
      recipe.flags.push_back(*word);
    }
  }
}

void read_link(const std::vector<std::string>& words, const fs::path& build,
               const std::vector<std::string>& objects, Recipe& recipe) {
  bool seen = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "-o") {
      ++i;
    } else if (std::find(objects.begin(), objects.end(), words[i]) != objects.end()) {
      if (!seen) recipe.objects_at = recipe.link.size();
      seen = true;
    } else if (words[i].starts_with("-")) {
      recipe.link.push_back({words[i], false});
    } else {
      recipe.link.push_back({(build / words[i]).lexically_normal().string(), true});
    }
  }
  if (!seen) throw Error("the worker is not linked with the exercise files");
}

}  // namespace

std::vector<std::string> shell_words(const std::string& line) {
  std::vector<std::string> words;
  bool open = false;
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool blank = c == ' ' || c == '\t' || c == '\n';
    if (quote == 0 && blank) {
      open = false;
      continue;
    }
    if (!open) words.emplace_back();
    open = true;
    if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    } else if (c == '\\' && quote != '\'' && i + 1 < line.size()) {
      words.back() += line[++i];
    } else {
      words.back() += c;
    }
  }
  return words;
}

Recipe parse_recipe(const std::string& commands, const fs::path& build, const CourseLab& lab) {
  const std::string code = fmt::format("lab{}_worker_code.dir/", lab.number());
  std::vector<std::vector<std::string>> compiles;
  std::vector<std::string> link;
  std::istringstream lines(commands);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> words = shell_words(line);
    if (after(words, "-c").empty()) {
      if (after(words, "-o") == fmt::format("bin/lab{}_worker", lab.number())) link = words;
    } else if (after(words, "-o").find(code) != std::string::npos) {
      compiles.push_back(words);
    }
  }
  // CMake's form of a link command: ": && COMMAND && :"
  if (compiles.size() != lab.files.size() || link.size() < 8 || link[0] != ":" || link[1] != "&&" ||
      link.back() != ":" || link[link.size() - 2] != "&&") {
    throw Error("the build's commands for lab {} are not of the form that is known", lab.number());
  }
  Recipe recipe;
  recipe.compiler = link[2];
  read_compile(compiles.front(), recipe);
  std::vector<std::string> objects;
  std::transform(compiles.begin(), compiles.end(), std::back_inserter(objects),
                 [](const std::vector<std::string>& words) { return after(words, "-o"); });
  read_link({link.begin() + 3, link.end() - 2}, build, objects, recipe);
  return recipe;
}

Recipe recipe_of(const fs::path& build, const CourseLab& lab) {
  return parse_recipe(ninja_commands(build, fmt::format("bin/lab{}_worker", lab.number())), build,
                      lab);
}

}  // namespace carlo::grader
