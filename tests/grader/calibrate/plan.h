#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

namespace carlo::grader {

/// The name of a lab's correct answer, in the place of a mistake's name.
constexpr const char* the_solution = "solution";

/// A subject of judgement: a lab's solution or one of its mistakes.
struct Subject {
  int lab = 0;
  std::string what = the_solution;  ///< or the mistake's name
  std::string exercise = {};        ///< "1.2", if a mistake; empty: all are judged
  std::string diagnosis = {};       ///< the expected one; "crash" if the program must be ended
  std::filesystem::path lab_json = {}, judge = {}, worker = {};

  bool is_solution() const { return what == the_solution; }
};

/// The key of one judgement: subject, seed, and programs. `programs` changes with the judge, the
/// worker and lab.json, so that no result outlives its programs.
struct JobKey {
  int lab = 0;
  std::string what;
  std::uint64_t seed = 0;
  std::string programs;

  bool operator<(const JobKey& other) const {
    return std::tie(lab, what, seed, programs) <
           std::tie(other.lab, other.what, other.seed, other.programs);
  }
};

struct Job {
  JobKey key;
  Subject subject;
};

/// Where a tree keeps its labs and its programs.
struct Places {
  std::filesystem::path labs, programs;
};

/// The solutions and all mistakes of these labs, in order (every lab when none is named). Throws
/// Error for a lab that does not exist, and a program or a list of mistakes that was not built.
std::vector<Subject> subjects(const Places& places, const std::vector<int>& labs);

/// Returns `count` judgements of each solution, then `mistake_count` of each mistake, one seed
/// after the other: whenever the run is stopped, all subjects have been judged about equally often.
std::vector<Job> jobs(const std::vector<Subject>& subjects, int count, int mistake_count,
                      std::uint64_t first_seed);

}  // namespace carlo::grader
