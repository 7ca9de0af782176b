#include "grader/calibrate/plan.h"

#include "course/guide/exercises.h"
#include "random/hash.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

fs::path program(const Places& places, const std::string& name) {
  fs::path path = places.programs / name;
  if (!fs::is_regular_file(path)) throw Error("{} was not built", path.string());
  return path;
}

/// Returns the folder NN_name of a lab below `parent`.
fs::path folder(const fs::path& parent, const Lab& lab) {
  return parent / fmt::format("{:02}_{}", lab.number, lab.name);
}

/// The mistakes of a lab in order of their solutions' files and their names. The folder of programs
/// holds the list that tests/grader/mistakes.awk makes of them.
std::vector<Subject> mistakes(const Places& places, const Subject& solution,
                              const std::string& lab_name) {
  std::istringstream list(read_file(program(places, lab_name + "_mistakes.tsv")));
  std::vector<std::string> lines;
  for (std::string line; std::getline(list, line);)
    lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  std::vector<Subject> found;
  for (const std::string& line : lines) {
    std::istringstream words(line);
    std::string file, table;
    std::getline(words, file, '\t');
    Subject subject = solution;
    std::getline(words, subject.what, '\t');
    std::getline(words, table, '\t');
    std::getline(words, subject.exercise, '\t');
    std::getline(words, subject.diagnosis, '\t');
    subject.worker = program(places, fmt::format("{}_worker_mistake_{}", lab_name, subject.what));
    found.push_back(subject);
  }
  return found;
}

/// A word from a file's bytes.
std::uint64_t word_of_file(const fs::path& path) {
  const std::string bytes = read_file(path);
  std::uint64_t word = bytes.size();
  for (std::size_t i = 0; i < bytes.size(); i += sizeof word) {
    std::uint64_t part = 0;
    std::memcpy(&part, bytes.data() + i, std::min(sizeof part, bytes.size() - i));
    word = mix(word ^ part);
  }
  return word;
}

/// Reads each file only once: a judge serves all mistakes of its lab.
class Fingerprints {
 public:
  std::string of(const Subject& subject) {
    return fmt::format("{:016x}",
                       hash(word(subject.judge), word(subject.worker), word(subject.lab_json)));
  }

 private:
  std::uint64_t word(const fs::path& path) {
    const auto known = words_.find(path);
    if (known != words_.end()) return known->second;
    return words_[path] = word_of_file(path);
  }
  std::map<fs::path, std::uint64_t> words_;
};

}  // namespace

std::vector<Subject> subjects(const Places& places, const std::vector<int>& wanted) {
  std::vector<Subject> list;
  const std::vector<Lab> labs = load_labs(places.labs);
  for (const int number : wanted)
    (void)find_lab(labs, number);
  for (const Lab& lab : labs) {
    const bool asked = std::find(wanted.begin(), wanted.end(), lab.number) != wanted.end();
    if (!wanted.empty() && !asked) continue;
    const std::string name = fmt::format("lab{:02}", lab.number);
    Subject subject;
    subject.lab = lab.number;
    subject.lab_json = folder(places.labs, lab) / "lab.json";
    subject.judge = program(places, name + "_judge");
    subject.worker = program(places, name + "_worker_solution");
    list.push_back(subject);
    for (const Subject& mistake : mistakes(places, subject, name))
      list.push_back(mistake);
  }
  return list;
}

std::vector<Job> jobs(const std::vector<Subject>& subjects, int count, int mistake_count,
                      std::uint64_t first_seed) {
  Fingerprints fingerprints;
  std::vector<Job> list;
  for (const bool solutions : {true, false}) {
    const int seeds = solutions ? count : mistake_count;
    for (int i = 0; i < seeds; ++i) {
      for (const Subject& subject : subjects) {
        if (subject.is_solution() != solutions) continue;
        const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
        list.push_back({{subject.lab, subject.what, seed, fingerprints.of(subject)}, subject});
      }
    }
  }
  return list;
}

}  // namespace carlo::grader
