#include "course/verdict/verdict_json.h"

#include "course/verdict/printed.h"
#include "support/error.h"

#include <string>
#include <utility>

namespace carlo {

static void fields(JsonFields& json, Diagnosis& diagnosis) {
  json("id", diagnosis.id);
  json("sentence", diagnosis.sentence);
}

static void fields(JsonFields& json, Effect& effect) {
  json("measured", effect.measured);
  json("resolution", effect.resolution);
  json("unit", effect.unit);
  json("spread", effect.spread);
}

static void fields(JsonFields& json, Verdict& verdict) {
  json("passed", verdict.passed);
  json("what", verdict.what);
  json("measured", verdict.measured);
  json("expected", verdict.expected);
  json("certainty", verdict.certainty);
  json("diagnoses", verdict.diagnoses);
  json("p", verdict.p);
  json("effect", verdict.effect);
  json("figure", verdict.figure);
}

static void fields(JsonFields& json, TestRecord& test) {
  json("sentence", test.sentence);
  json.named("aspect", test.aspect, to_string, aspect_named);
  json.named("status", test.status, to_string, status_named);
  json("problem", test.problem);
  json("printed", test.printed);
  json("lost_lines", test.lost_lines);
  json("lacks_line", test.lacks_line);
  json("skipped", test.skipped);
  json("needs", test.needs);
  json("verdicts", test.verdicts);
}

static void fields(JsonFields& json, ByItself& judgement) {
  json.named("status", judgement.status, to_string, status_named);
  json("points", judgement.points);
  json("replaced", judgement.replaced);
  json("diagnoses", judgement.diagnoses);
  json("failures", judgement.failures);
}

void fields(JsonFields& json, ExerciseResult& result) {
  json("tag", result.tag);
  if (!result.tag.starts_with("Lab ")) {
    json.fail(fmt::format("\"{}\" is no exercise", clipped(result.tag, 40)));
  }
  json("title", result.title);
  json.named("status", result.status, to_string, status_named);
  json("points", result.points);
  json("max", result.max);
  json("diagnoses", result.diagnoses);
  json("unsound", result.unsound);
  json("missing", result.missing);
  json("begun", result.begun);
  json("by_itself", result.by_itself);
  json("tests", result.tests);
  for (TestRecord& test : result.tests)
    test.tag = result.tag;
}

namespace {

/// The longest text of one kind: a student's program can make a message long.
constexpr std::size_t most_words = 2000;

void cut(std::string& text) {
  if (text.size() > most_words) text = text.substr(0, most_words) + " ...";
}

void cut(std::vector<Diagnosis>& diagnoses) {
  for (Diagnosis& diagnosis : diagnoses)
    cut(diagnosis.sentence);
}

/// A text as JSON, with its escapes.
struct Words {
  std::string text;
};
void fields(JsonFields& json, Words& words) {
  json("", words.text);
}

/// The bytes that the document may still grow by. The shares leave room for the rest of it.
class Ration {
 public:
  /// Removes what does not fit into a lab's JSON. Returns whether verdicts were lost.
  bool take(TestRecord& test) {
    cut(test.problem);
    cut(test.printed);
    cut(test.needs);
    if (!gives(printed_, Words{test.problem})) test.problem = test.problem.substr(0, 100);
    if (!gives(printed_, Words{test.printed})) test.printed.clear();
    return std::erase_if(test.verdicts, [&](Verdict& verdict) { return !keeps(verdict); }) > 0;
  }

 private:
  /// Returns whether the value still fits; if so, subtracts it from what is left.
  template <class T>
  static bool gives(std::size_t& left, const T& value) {
    const std::size_t size = json_text(value).size();
    if (size > left) return false;
    left -= size;
    return true;
  }

  bool keeps(Verdict& verdict) {
    for (std::string* words :
         {&verdict.what, &verdict.measured, &verdict.expected, &verdict.certainty})
      cut(*words);
    cut(verdict.diagnoses);
    const std::optional<Figure> figure = std::exchange(verdict.figure, std::nullopt);
    if (!gives(verdicts_, verdict)) return false;
    if (figure && !verdict.passed && gives(figures_, *figure)) verdict.figure = figure;
    return true;
  }

  std::size_t figures_ = most_json_bytes / 2;
  std::size_t printed_ = most_json_bytes / 8;
  std::size_t verdicts_ = most_json_bytes / 4;
};

/// Trims a lab's verdicts to what its JSON holds.
void ration(LabResult& result) {
  Ration left;
  for (ExerciseResult& exercise : result.exercises) {
    cut(exercise.diagnoses);
    if (exercise.by_itself) cut(exercise.by_itself->diagnoses);
    for (TestRecord& test : exercise.tests)
      if (left.take(test)) result.cut = true;
  }
}

}  // namespace

void fields(JsonFields& json, LabResult& result) {
  if (!json.reading()) ration(result);
  json("lab", result.lab);
  json("title", result.title);
  json("whole", result.whole);
  json.also("points", result.earned());
  json.also("max", result.possible());
  json.as_text("seed", result.seed);
  json("usual_seed", result.usual_seed);
  json("sandbox", result.sandbox);
  json("cut", result.cut);
  json("exercises", result.exercises);
}

std::string to_text(const LabResult& result) {
  return json_text(result) + "\n";
}

LabResult lab_result_from_text(const std::string& text) {
  return from_json_text<LabResult>(text, "these are no verdicts");
}

}  // namespace carlo
