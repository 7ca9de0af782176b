#include "grader/grade/similarity.h"

#include "course/cli/program.h"
#include "grader/grade/class.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* longest_minutes = "20";

fs::path packages_of(const fs::path& tree) {
  return tree / "build/similarity";
}

/// Names what all submissions were given: stubs, and what they must not be found to share with the
/// suite's solution.
json given(const fs::path& tree, const CourseLab& lab) {
  json list = json::array();
  for (const char* folder : {"labs", "solutions"}) {
    json files = json::object();
    for (const std::string& file : lab.files) {
      const fs::path path = tree / folder / lab.folder / file;
      if (fs::exists(path)) files[file] = read_file(path);
    }
    list.push_back(files);
  }
  return list;
}

void write_task(const Course& course, const std::vector<Source>& sources, const fs::path& work) {
  json task{{"labs", json::array()}, {"submissions", json::array()}, {"most_pairs", most_pairs}};
  for (const CourseLab& lab : course.labs)
    task["labs"].push_back({{"folder", lab.folder}, {"given", given(course.tree, lab)}});
  for (const Source& source : sources)
    task["submissions"].push_back(source.name);
  write_file(work / "task.json", task.dump());
}

/// Texts of strangers are parsed there, so time and memory are limited.
void run_comparison(const fs::path& tree, const fs::path& work) {
  const pid_t child =
      start_program({"timeout", "--kill-after=5", std::string(longest_minutes) + "m", "node",
                     "--max-old-space-size=3000", tree / "tests/grader/similarity/similarity.mjs",
                     packages_of(tree), work},
                    {.ends_with_us = true});
  const int status = wait_for(child);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 124)
    throw Error("--similarity: comparing took more than {} minutes", longest_minutes);
  if (status != 0) throw Error("--similarity: comparing failed; node says why above");
}

std::vector<SharedLine> lines_from(const json& list) {
  std::vector<SharedLine> lines;
  for (const json& line : list)
    lines.push_back({line.at("file"), line.at("row"), line.at("text")});
  return lines;
}

SimilarPair pair_from(const json& entry) {
  SimilarPair pair{entry.at("first"), entry.at("second"), entry.at("similarity"),
                   entry.at("longest"), entry.at("overlap")};
  for (const json& fragment : entry.value("fragments", json::array())) {
    pair.fragments.push_back(
        {lines_from(fragment.at("left")), lines_from(fragment.at("right")), fragment.at("more")});
  }
  return pair;
}

/// The value below which a share of the pairs lies, of pairs with the most similar one first.
double quantile(const std::vector<SimilarPair>& pairs, double share) {
  const auto last = static_cast<double>(pairs.size() - 1);
  return pairs[static_cast<std::size_t>(std::lround((1 - share) * last))].similarity;
}

}  // namespace

std::optional<Usual> usual_of(const LabSimilarity& lab) {
  if (lab.pairs.size() < fewest_pairs) return std::nullopt;
  Usual usual{quantile(lab.pairs, 0.25), quantile(lab.pairs, 0.5), quantile(lab.pairs, 0.75)};
  usual.threshold =
      std::clamp(usual.upper + 3 * (usual.upper - usual.lower), least_threshold, most_threshold);
  return usual;
}

std::vector<std::vector<std::string>> groups_of(const LabSimilarity& lab, double threshold) {
  std::map<std::string, std::string> leader;
  for (const std::string& name : lab.compared)
    leader[name] = name;
  for (const SimilarPair& pair : lab.pairs) {
    if (pair.similarity <= threshold) continue;
    const std::string from = leader.at(pair.second), to = leader.at(pair.first);
    for (auto& [name, its] : leader)
      if (its == from) its = to;
  }
  std::map<std::string, std::vector<std::string>> members;
  for (const auto& [name, its] : leader)
    members[its].push_back(name);
  std::vector<std::vector<std::string>> groups;
  for (const auto& [its, names] : members)
    if (names.size() > 1) groups.push_back(names);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return groups;
}

std::vector<LabSimilarity> similarities_from_json(const std::string& text) {
  try {
    std::vector<LabSimilarity> labs;
    const json result = json::parse(text);
    for (const json& entry : result.at("labs")) {
      LabSimilarity lab{entry.at("folder"), entry.at("compared")};
      for (const json& one : entry.at("left_out"))
        lab.left_out.emplace_back(one.at("name"), one.at("why"));
      for (const json& pair : entry.at("pairs"))
        lab.pairs.push_back(pair_from(pair));
      labs.push_back(lab);
    }
    return labs;
  } catch (const json::exception& error) {
    throw Error("--similarity: the comparison's result cannot be read: {}", error.what());
  }
}

std::string similarity_csv(const std::vector<LabSimilarity>& labs) {
  std::string out = "lab,first,second,similarity,longest fragment,overlap,remark\n";
  for (const LabSimilarity& lab : labs) {
    const std::optional<Usual> usual = usual_of(lab);
    for (const SimilarPair& pair : lab.pairs) {
      const bool stands_out = usual && pair.similarity > usual->threshold;
      out +=
          fmt::format("{},{},{},{:.4f},{},{},{}\n", lab.folder, pair.first, pair.second,
                      pair.similarity, pair.longest, pair.overlap, stands_out ? "stands out" : "");
    }
    for (const auto& [name, why] : lab.left_out)
      out += fmt::format("{},{},,,,,not compared: {}\n", lab.folder, name, why);
  }
  return out;
}

void need_similarity(const fs::path& tree) {
  const fs::path lock = tree / "tests/grader/similarity/package-lock.json";
  const fs::path installed = packages_of(tree) / "node_modules/.installed";
  if (!fs::exists(lock)) throw Error("--similarity: tests/grader/similarity is not in this tree");
  if (!fs::exists(installed) || read_file(installed) != read_file(lock))
    throw Error("--similarity: Dolos is not installed: ./carlo grade --similarity installs it");
}

void compare_class(const Course& course, const std::vector<Source>& sources,
                   const std::map<std::string, std::string>& shown, bool code, const fs::path& out,
                   int workers) {
  const fs::path work = course.clean.path() / "similarity";
  fs::create_directory(work);
  fs::permissions(work, fs::perms::owner_all);
  write_task(course, sources, work);
  write_texts(course, sources, work, workers);
  run_comparison(course.tree, work);
  const auto labs = similarities_from_json(read_file(work / "result.json"));
  write_file(out / "similarity.csv", similarity_csv(labs));
  similarity_page(labs, shown, code).write(out / "similarity.html");
  fmt::print("what submissions share: {}\n", (out / "similarity.html").string());
}

}  // namespace carlo::grader
