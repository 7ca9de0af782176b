#pragma once

#include "course/report/page.h"
#include "grader/grade/judging.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What submissions share (--similarity): tests/grader/similarity compares their texts with Dolos;
// here that is started, judged by the class's own distribution and written.

namespace carlo::grader {

struct SharedLine {
  std::string file;
  int row = 0;
  std::string text;
};

/// Matching lines of two submissions; `more` are not shown.
struct Fragment {
  std::vector<SharedLine> left, right;
  int more = 0;
};

/// Two submissions. The similarity is the share of their own code that both have; what everybody
/// was given does not count. Overlap and longest fragment are in fingerprints.
struct SimilarPair {
  std::string first, second;
  double similarity = 0;
  int longest = 0, overlap = 0;
  std::vector<Fragment> fragments = {};
};

/// One lab; the most similar pair is the first.
struct LabSimilarity {
  std::string folder;
  std::vector<std::string> compared = {};
  std::vector<std::pair<std::string, std::string>> left_out = {};  ///< name, and why
  std::vector<SimilarPair> pairs = {};
};

/// What is usual in a class, and where pairs begin to stand out.
struct Usual {
  double lower = 0, median = 0, upper = 0;  ///< quartiles of the pairs' similarities
  double threshold = 0;
};

constexpr std::size_t most_pairs = 50;    ///< of a lab on the page, with their fragments
constexpr std::size_t fewest_pairs = 15;  ///< from which quartiles say something
constexpr double least_threshold = 0.3;   ///< what short exercises may share by chance
constexpr double most_threshold = 0.6;    ///< twice that: above it a pair always stands out

/// Returns it for the pairs of one lab; none if they are too few. The threshold lies three
/// interquartile ranges above the upper quartile, and between least_threshold and most_threshold:
/// few copies among many pairs do not move it, and a ring of many does not hide itself.
std::optional<Usual> usual_of(const LabSimilarity& lab);

/// Returns the submissions that pairs above the threshold connect: the largest group first.
std::vector<std::vector<std::string>> groups_of(const LabSimilarity& lab, double threshold);

/// Returns what similarity.mjs found. Throws Error if the text is not that.
std::vector<LabSimilarity> similarities_from_json(const std::string& text);

/// Returns one line per pair, and one per submission that was not compared.
std::string similarity_csv(const std::vector<LabSimilarity>& labs);

/// Returns the page. `shown` says how to call each submission; without `code` no line of theirs is
/// shown.
Page similarity_page(const std::vector<LabSimilarity>& labs,
                     const std::map<std::string, std::string>& shown, bool code);

/// Throws Error unless all that comparing needs is there.
void need_similarity(const std::filesystem::path& tree);

/// Compares submissions and writes similarity.csv and similarity.html into `out`. Throws Error.
void compare_class(const Course& course, const std::vector<Source>& sources,
                   const std::map<std::string, std::string>& shown, bool code,
                   const std::filesystem::path& out, int workers);

}  // namespace carlo::grader
