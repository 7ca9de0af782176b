#include "grader/grade/class_page.h"
#include "grader/grade/outputs.h"
#include "grader/grade/recipe.h"
#include "grader/grade/record.h"
#include "grader/grade/sha256.h"
#include "grader/page/grade_page.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace carlo;
using namespace carlo::grader;
using nlohmann::json;

namespace {

Lab demo_lab() {
  return {
      1,
      "demo",
      "Demo",
      {{"Lab 1.1", "First", 2, {"f"}, {"a", "b"}}, {"Lab 1.2", "Second", 3, {"g"}, {"a", "b"}}}};
}

LabResult verdict(double first, double second) {
  LabResult result;
  result.lab = 1;
  result.title = "Demo";
  result.sandbox = "s";
  const auto add = [&](const char* tag, double points, int max, const char* problem) {
    ExerciseResult exercise;
    exercise.tag = tag;
    exercise.points = points;
    exercise.max = max;
    exercise.status = points == max ? Status::passed : Status::failed;
    exercise.tests = {{tag, "it holds", {}, exercise.status, problem, ""}};
    result.exercises.push_back(exercise);
  };
  add("Lab 1.1", first, 2, "");
  add("Lab 1.2", second, 3, "wrong \x1b[2J\xFF]]>&\xEF\xBF\xBE");  // the last is U+FFFE
  return result;
}

Record record(const std::string& name, const LabGrade& lab) {
  return {name, "key", {"notes.txt"}, {lab}};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("SHA-256 gives the digests of FIPS 180-4", "[grade]") {
  CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  Sha256 million;
  const std::string thousand(1000, 'a');
  for (int i = 0; i < 1000; ++i)
    million.add(thousand);
  CHECK(million.hex() == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("a command line falls into words as in a shell", "[grade]") {
  CHECK(shell_words("a  \"b c\"d 'e\\f' g\\ h -DX=\\\"y\\\" ''") ==
        std::vector<std::string>{"a", "b cd", "e\\f", "g h", "-DX=\"y\"", ""});
}

TEST_CASE("a recipe is read from ninja's commands", "[grade]") {
  const CourseLab lab{demo_lab(), "01_demo", {"demo.cpp"}};
  const std::string compile =
      "/usr/bin/ccache /usr/bin/c++ -DX -I/t/labs/01_demo -isystem /i -O3 -MD -MT o -MF d "
      "-o labs/lab01_worker_code.dir/demo.o -c /t/labs/01_demo/demo.cpp\n";
  const std::string link =
      ": && /usr/bin/c++ -O3 p.o labs/lab01_worker_code.dir/demo.o -o bin/lab01_worker l.a "
      "/usr/lib/x.so && :\n";
  const Recipe recipe = parse_recipe(compile + link, "/b", lab);
  CHECK(recipe.compiler == "/usr/bin/c++");
  CHECK(recipe.flags == std::vector<std::string>{"-DX", "-O3"});
  CHECK(recipe.includes == std::vector<std::filesystem::path>{"/t/labs/01_demo", "/i"});
  REQUIRE(recipe.link.size() == 4);
  CHECK(recipe.link[0].text == "-O3");
  CHECK(recipe.link[1].text == "/b/p.o");
  CHECK(recipe.objects_at == 2);
  CHECK(recipe.link[2].text == "/b/l.a");
  CHECK(recipe.link[3].text == "/usr/lib/x.so");
  CHECK_THROWS_AS(parse_recipe(link, "/b", lab), Error);
  CHECK_THROWS_AS(parse_recipe(compile, "/b", lab), Error);
}

TEST_CASE("marks come from the judge's verdict, and only if it makes sense", "[grade]") {
  const LabGrade grade = judged(demo_lab(), verdict(2, 1.5));
  CHECK(grade.points() == 3.5);
  CHECK(grade.max() == 5);
  CHECK_THROWS_AS(judged(demo_lab(), verdict(3, 1)), Error);
  CHECK_THROWS_AS(judged(demo_lab(), verdict(-1, 1)), Error);
  CHECK_THROWS_AS(judged(demo_lab(), verdict(1.1, 1)), Error);
  CHECK_THROWS_AS(judged(demo_lab(), {}), Error);
  LabResult other = verdict(1, 1);
  other.exercises[0].tag = "Lab 1.2";
  CHECK_THROWS_AS(judged(demo_lab(), other), Error);
}

TEST_CASE("an error of the grader has no marks, a missing file has 0", "[grade]") {
  CHECK(unjudged(demo_lab(), Status::not_submitted, "").points() == 0);
  const LabGrade ours = unjudged(demo_lab(), Status::grader_error, "the disk is full");
  CHECK_FALSE(ours.points().has_value());
  const Record failed = record("a", ours);
  CHECK_FALSE(failed.complete());
  CHECK(has(failed.status(), "an error of the grader"));
  CHECK_FALSE(json::parse(gradescope_json(failed)).contains("score"));
  CHECK(has(junit_xml(failed), "<error"));
  CHECK(has(class_csv({failed}), "a,,,,,5,lab 1 not graded: an error of the grader,\"./\"\n"));
}

TEST_CASE("the class's CSV is sorted and holds points alone", "[grade]") {
  LabGrade slow = judged(demo_lab(), verdict(2, 1.5));
  slow.judge_seconds = 100;
  const LabGrade fast = judged(demo_lab(), verdict(2, 1.5));
  const LabGrade none = unjudged(demo_lab(), Status::not_submitted, "");
  Record odd = record("a", none);
  odd.source = "=1+\"a\",\n.zip";
  const std::string csv = class_csv({record("b", slow), odd});
  CHECK(csv ==
        "name,1.1,1.2,lab 1,total,max,status,source\n"
        "a,0,0,0,0,5,lab 1 not submitted,\"./=1+\"\"a\"\", .zip\"\n"
        "b,2,1.5,3.5,3.5,5,graded,\"./\"\n");
  CHECK(csv == class_csv({odd, record("b", fast)}));
}

TEST_CASE("Gradescope's and JUnit's files are well formed whatever a program said", "[grade]") {
  LabGrade lab = judged(demo_lab(), verdict(2, 1.5));
  lab.compiler = "warning: \xFF <b> \x01";
  const Record graded = record("a", lab);
  const json results = json::parse(gradescope_json(graded));
  CHECK(results["score"] == 3.5);
  REQUIRE(results["tests"].size() == 2);
  CHECK(results["tests"][1]["score"] == 1.5);
  CHECK(results["tests"][1]["max_score"] == 3);
  CHECK(results["tests"][1]["number"] == "1.2");
  CHECK(results["tests"][1]["status"] == "failed");
  pugi::xml_document xml;
  REQUIRE(xml.load_string(junit_xml(graded).c_str()));
  const pugi::xml_node suite = xml.child("testsuites").child("testsuite");
  CHECK(suite.attribute("tests").as_int() == 2);
  CHECK(suite.attribute("failures").as_int() == 1);
  CHECK_FALSE(has(junit_xml(graded), "\x1b"));
  CHECK_FALSE(has(junit_xml(graded), "\xEF\xBF\xBE"));
}

TEST_CASE("a record is read back as it was written", "[grade]") {
  LabGrade lab = judged(demo_lab(), verdict(2, 1.5));
  lab.note.assign(1, 'n');  // a literal here causes a false warning in GCC 12
  lab.judge_seconds = 1.5;
  const Record before = record("a", lab);
  const Record after = record_from_json(to_json(before));
  CHECK(to_json(after) == to_json(before));
  CHECK(class_csv({after}) == class_csv({before}));
  CHECK_THROWS_AS(record_from_json("{}"), Error);
  CHECK_THROWS_AS(record_from_json("nothing"), Error);
  CHECK(has(report_text(before), "notes.txt"));
}

TEST_CASE("The class's page counts who is right, and what builds on what is not right", "[grade]") {
  const Record right = record("zoe", judged(demo_lab(), verdict(2, 3)));
  LabResult both = verdict(0, 0);
  both.exercises[0].diagnoses = {{"off-by-one", "one < too many"}, {"other", "unlikely"}};
  both.exercises[1].unsound = {"Lab 1.1"};
  const Record wrong = record("wrong<b>", judged(demo_lab(), both));
  LabResult itself = verdict(0, 3);
  itself.exercises[1].status = Status::failed;
  itself.exercises[1].unsound = {"Lab 1.1"};
  itself.exercises[1].by_itself = ByItself{Status::passed, 3, {"Lab 1.1"}};
  const Record alone = record("alone", judged(demo_lab(), itself));
  CHECK(has(class_page({alone}, {}).html(),
            "<td class=\"itself\" title=\"1.2: right by itself: all points"));
  const Record broken = record("broken", unjudged(demo_lab(), Status::does_not_compile, ""));
  const std::string page = class_page({right, wrong, broken}, {}).html();
  CHECK(page == class_page({broken, wrong, right}, {}).html());
  CHECK(has(page, "The class in lab 1"));
  CHECK(has(page, "3 submissions, 3 of them graded; at most 5 points; 1 does not compile"));
  CHECK(has(page, "33 %"));
  CHECK(has(page, "one &lt; too many"));
  CHECK_FALSE(has(page, "unlikely"));
  CHECK(has(page, "wrong&lt;b&gt;"));
  CHECK_FALSE(has(page, "<b>"));
  CHECK(has(page, "<td class=\"wrong\" title=\"1.1: no points\">0</td><td class=\"follows\""));
  CHECK(has(page, "<td class=\"uncompiled\" colspan=\"2\">does not compile</td>"));
  CHECK(has(page, "<td>lab 1</td><td>the code does not compile.</td>"));
  // Best first.
  CHECK(page.find(">zoe</th>") < page.find(">broken</th>"));
}

TEST_CASE("Whoever is right by itself is so in every output", "[grade]") {
  LabResult result = verdict(0, 3);
  ExerciseResult& second = result.exercises[1];
  second.status = Status::failed;
  second.tests[0].status = Status::failed;
  second.diagnoses = {{"of-the-first", "the first one's cause"}};
  second.unsound = {"Lab 1.1"};
  second.by_itself = ByItself{Status::passed, 3, {"Lab 1.1"}};
  const LabGrade lab = judged(demo_lab(), result);
  const Record alone = record("alone", lab);
  CHECK(has(class_csv({alone}), ",0,3,3,3,5,1.2 right by itself,"));
  const std::string sentence = "1.2 is right by itself; Lab 1.1, which it calls, is not\n";
  CHECK(has(text_of(lab, lab.result.exercises[1]), sentence));
  const json test = json::parse(gradescope_json(alone))["tests"][1];
  CHECK(test["status"] == "passed");
  CHECK(test["score"] == 3);
  CHECK(test["extra_data"]["status"] == "right_by_itself");
  CHECK(has(test["output"], sentence));
  CHECK(has(junit_xml(alone), "failures=\"1\""));
  const std::string page = grade_page({{lab.result}}, {"alone"});
  CHECK(has(page, "<span class=\"words\"> right by itself</span>"));
  CHECK(has(page, "3 of 3 points"));
  for (const std::string& text :
       {page, class_page({alone}, {}).html(), test["output"].get<std::string>()}) {
    CHECK_FALSE(has(text, "the first one"));
    CHECK_FALSE(has(text, "./carlo hint 1.2"));
  }
}

TEST_CASE("What is wrong by itself has its own causes, not those of what it calls", "[grade]") {
  LabResult result = verdict(0, 0);
  ExerciseResult& second = result.exercises[1];
  second.diagnoses = {{"of-the-first", "the first one's cause"}};
  second.unsound = {"Lab 1.1"};
  second.by_itself =
      ByItself{Status::failed, 0, {"Lab 1.1"}, {{"its-own", "its own cause"}}, {"it holds alone"}};
  const LabGrade lab = judged(demo_lab(), result);
  const std::string page = grade_page({{lab.result}}, {"both"});
  for (const std::string& text : {page, class_page({record("both", lab)}, {}).html(),
                                  text_of(lab, lab.result.exercises[1])}) {
    CHECK(has(text, "its own cause"));
    CHECK_FALSE(has(text, "the first one"));
  }
  CHECK(page.find("it holds alone") < page.find("What was measured with your own Lab 1.1"));
}

TEST_CASE("The class's page counts crashes and time limits by exercise", "[grade]") {
  LabResult crash = verdict(0, 0);
  crash.exercises[0].status = crash.exercises[0].tests[0].status = Status::crashed;
  crash.exercises[0].tests[0].problem = "it crashed: segmentation fault, in labs/a.cpp:3 (n = 1)";
  crash.exercises[1].status = Status::timeout;
  crash.exercises[1].diagnoses = {{"named", "it is named."}};
  const std::string page =
      class_page({record("a", judged(demo_lab(), crash)), record("b", judged(demo_lab(), crash))},
                 {})
          .html();
  const std::string row = "<tr><td class=\"number\">2</td><td>1.";
  CHECK(has(page, row + "1</td><td>the program crashes: segmentation fault.</td>"));
  CHECK(has(page, row + "2</td><td>it is named.</td>"));
  CHECK(has(page, row + "2</td><td>the program is not done in time"));
  CHECK(has(page, ": no points\">0<small> crash</small></td>"));
  CHECK(has(page, ": no points\">0<small> time</small></td>"));
}

TEST_CASE("Numbers in place of names tell no ranks, and stay as they are", "[grade]") {
  std::vector<Record> class_of_ten;
  for (int i = 0; i < 10; ++i)
    class_of_ten.push_back(record(std::string("name") + static_cast<char>('0' + i),
                                  judged(demo_lab(), verdict(i < 5 ? 2 : 0, 0))));
  const ClassWords words{false, "a secret"};
  const std::string page = class_page(class_of_ten, words).html();
  CHECK_FALSE(has(page, "name3"));
  CHECK(has(page, ">student 10</th>"));
  const auto shown = shown_names(class_of_ten, words);
  const auto others = shown_names(class_of_ten, {false, "another secret"});
  CHECK(shown != others);
  std::reverse(class_of_ten.begin(), class_of_ten.end());
  CHECK(shown_names(class_of_ten, words) == shown);
  CHECK(class_page(class_of_ten, words).html() == page);
}

TEST_CASE("The class's page shows that marks are missing", "[grade]") {
  const Record failed = record("a", unjudged(demo_lab(), Status::grader_error, "no space"));
  const std::string page =
      class_page({failed, record("b", judged(demo_lab(), verdict(2, 3)))}, {}).html();
  CHECK(has(page, "2 submissions, 1 of them graded"));
  CHECK(has(page, "<td class=\"unjudged\" colspan=\"2\">not graded: an error of the grader</td>"));
  CHECK(has(page, "100 %"));
}
