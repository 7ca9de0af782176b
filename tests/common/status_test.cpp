// A student's progress, stored verdicts, and the presentation of compiler messages.

#include "course/guide/status.h"

#include "course/cli/wrap.h"
#include "course/guide/compiler_messages.h"
#include "course/guide/own_files.h"
#include "course/guide/verdicts.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace fs = std::filesystem;
using namespace carlo;

namespace {

constexpr const char* lab_text = R"({"lab": 1, "name": "demo", "title": "Demo", "exercises": [
  {"tag": "Lab 1.1", "title": "First", "points": 2, "functions": ["f", "g"],
   "hints": ["nudge", "plan"]},
  {"tag": "Lab 1.2", "title": "Second", "points": 3, "functions": ["h"],
   "hints": ["nudge", "plan"]},
  {"tag": "Lab 1.3", "title": "Third", "points": 4, "functions": ["k"],
   "hints": ["nudge", "plan"], "uses": ["Lab 1.1"]}]})";

/// A tree with one lab.
class Tree {
 public:
  Tree() : root_(fs::temp_directory_path() / fmt::format("carlo_status_{}", ::getpid())) {
    fs::create_directories(root_ / "labs/01_demo");
    write_file(root_ / "labs/01_demo/lab.json", lab_text);
    write("return 1;", "throws", "throws");
    list_ = load_labs(labs());
  }
  ~Tree() {
    std::error_code ec;
    fs::remove_all(root_, ec);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  void write(const std::string& first, const std::string& second, const std::string& third,
             const std::string& shared = "") const {
    const auto body = [](const std::string& tag, const std::string& text) {
      return text == "throws" ? fmt::format("  carlo::not_implemented(\"{}\", \"L\");\n", tag)
                              : text + "\n";
    };
    write_file(root_ / "labs/01_demo/demo.cpp",
               fmt::format("// Lab 01: demo\n{}\n// Lab 1.1 ----\n{}// Lab 1.2 ----\n{}"
                           "// Lab 1.3 ----\n{}",
                           shared, body("Lab 1.1", first), body("Lab 1.2", second),
                           body("Lab 1.3", third)));
  }
  fs::path labs() const { return root_ / "labs"; }
  fs::path kept() const { return root_ / ".carlo/verdicts.json"; }
  const Lab& lab() const { return list_.front(); }
  OwnCode code() const { return {labs(), lab()}; }
  LabStatus status() const {
    return status_of(lab(), labs(), VerdictBook(kept()), HintState(root_ / ".carlo/hints.json"));
  }
  Stage stage(std::size_t i) const { return status().exercises.at(i).stage; }
  void judge(const std::string& number, const std::string& status, double points) const {
    VerdictBook book(kept());
    ExerciseResult result;
    result.tag = "Lab " + number;
    result.points = points;
    result.status = status_named(status);
    result.tests = {{result.tag, "it holds", {}, result.status, "off by one", ""}};
    LabResult judged;
    judged.lab = 1;
    judged.exercises = {result};
    book.take(judged, lab(), code());
    book.save();
  }

 private:
  fs::path root_;
  std::vector<Lab> list_;
};

}  // namespace

TEST_CASE("an exercise is untouched, begun, judged, and edited since", "[course]") {
  const Tree tree;
  CHECK(tree.stage(0) == Stage::begun);
  CHECK(tree.stage(1) == Stage::untouched);
  tree.judge("1.1", "passed", 2);
  CHECK(tree.stage(0) == Stage::passed);
  CHECK_FALSE(tree.status().exercises[0].changed);
  tree.write("return 1;", "return 2;", "throws");
  CHECK(tree.stage(0) == Stage::passed);
  CHECK_FALSE(tree.status().exercises[0].changed);  // another exercise was
  tree.judge("1.2", "failed", 1);
  CHECK(tree.stage(1) == Stage::failed);
  CHECK(tree.status().points() == 3);
  tree.write("return 1;", "return 3;", "throws");
  CHECK(tree.stage(1) == Stage::edited);
  tree.write("throws", "return 2;", "throws");
  CHECK(tree.stage(0) == Stage::begun);  // one of its two functions is done
  CHECK(tree.status().points() == 1);    // and an open exercise has no points
  tree.write("return 1;", "return 2;", "throws");
  CHECK(tree.stage(0) == Stage::passed);  // the judged text is back
}

TEST_CASE("what has passed stays so until it is judged again, and says that it was changed",
          "[course]") {
  const Tree tree;
  tree.write("return 1;", "return 2;", "return 3;");
  for (const char* number : {"1.1", "1.2", "1.3"})
    tree.judge(number, "passed", number[2] - '0' + 1);
  CHECK(has(status_text({tree.status()}, false), "Lab 1 is done.\n"));
  tree.write("return 1;", "return 2;", "return 3;", "#include <cmath>\n");
  CHECK(tree.status().changed() == 0);  // a library's header changes no exercise
  tree.write("return 1;", "return 2;", "return 3;", "constexpr int two = 3;");
  const LabStatus status = tree.status();
  CHECK(status.passed() == 3);
  CHECK(status.changed() == 3);
  const std::string text = status_text({status}, false);
  CHECK(has(text, "9 of 9 points, 3 of 3 exercises (3 changed since)"));
  CHECK(has(text, "✓ 1.1  First   2 of 2  changed since"));
  CHECK(has(text, "Lab 1 is done. To judge what has changed since: ./carlo test 1"));
  tree.judge("1.1", "failed", 0);
  CHECK(tree.stage(0) == Stage::failed);
  CHECK(tree.status().passed() == 2);
}

TEST_CASE("helpers before the first heading, and exercises that are used, count as one's own",
          "[course]") {
  const Tree tree;
  tree.write("return 1;", "return 2;", "return 3;");
  for (const char* number : {"1.1", "1.2", "1.3"})
    tree.judge(number, "passed", 2);
  tree.write("return 4;", "return 2;", "return 3;");
  CHECK(tree.stage(1) == Stage::passed);
  CHECK_FALSE(tree.status().exercises[1].changed);
  CHECK(tree.status().exercises[2].changed);  // it uses Lab 1.1
  tree.write("return 1;", "return 2;", "return 3;", "int helper();");
  for (const ExerciseStatus& exercise : tree.status().exercises)
    CHECK(exercise.changed);
}

TEST_CASE("the part of the file that changed says which exercise is being worked on", "[course]") {
  const Tree tree;
  const OwnCode before = tree.code();
  tree.write("return 1;", "return 2;", "throws");
  const std::vector<const Exercise*> changed = tree.code().changed_since(before);
  REQUIRE(changed.size() == 1);
  CHECK(changed[0]->tag == "Lab 1.2");
  CHECK(tree.code().digest() != before.digest());
  tree.write("return 1;", "throws", "throws");
  CHECK(tree.code().digest() == before.digest());
}

TEST_CASE("what is next is the first that has not passed", "[course]") {
  const Tree tree;
  tree.write("return 1;", "return 2;", "throws");
  tree.judge("1.2", "passed", 3);
  CHECK(next_exercise(tree.status())->tag == "Lab 1.1");
  tree.judge("1.1", "passed", 2);
  CHECK(next_exercise(tree.status())->tag == "Lab 1.3");
  CHECK(next_exercise(std::vector{tree.status(), tree.status()})->tag == "Lab 1.3");
}

TEST_CASE("status for people has no escapes when piped; for programs it is JSON", "[course]") {
  const Tree tree;
  tree.judge("1.1", "failed", 1);
  const std::string text = status_text({tree.status()}, false);
  CHECK(text.find('\x1b') == std::string::npos);
  CHECK(has(text, "Lab 01  1 of 9 points, 0 of 3 exercises  Demo"));
  CHECK(has(text, "1 of 2  not right yet"));
  CHECK(has(text, "Next: Lab 1.1, First: ./carlo watch 1, ./carlo hint 1.1"));
  const nlohmann::json json = nlohmann::json::parse(status_json({tree.status()}));
  CHECK(json["next"] == "1.1");
  CHECK(json["labs"][0]["exercises"][0]["stage"] == "not right yet");
  CHECK(json["points"] == 1);
}

TEST_CASE("verdicts are kept without their figures", "[course]") {
  const Tree tree;
  Verdict verdict{false, "the mean", "1", "2", "", {}, {}};
  verdict.figure = Figure{"title", "", ListingFigure{{"a"}, {{"b"}}}};
  ExerciseResult result;
  result.tag = "Lab 1.1";
  result.tests = {{result.tag, "it holds", {verdict}, Status::failed, "", ""}};
  LabResult judged;
  judged.lab = 1;
  judged.exercises = {result};
  VerdictBook book(tree.kept());
  book.take(judged, tree.lab(), tree.code());
  book.save();
  const VerdictBook again(tree.kept());
  const KeptVerdict* kept = again.find(tree.lab().exercises[0]);
  REQUIRE(kept != nullptr);
  const Verdict& back = kept->result.tests.at(0).verdicts.at(0);
  CHECK(back.what == "the mean");
  CHECK_FALSE(back.figure.has_value());
}

TEST_CASE("a file of verdicts that is none, and verdicts of another lab, are errors", "[course]") {
  const Tree tree;
  VerdictBook book(tree.kept());
  LabResult other;
  other.lab = 2;
  CHECK_THROWS_AS(book.take(other, tree.lab(), tree.code()), Error);
  fs::create_directories(tree.kept().parent_path());
  write_file(tree.kept(), "[]");
  CHECK_THROWS_AS(VerdictBook(tree.kept()), Error);
}

TEST_CASE("only exercise files are a student's own", "[course]") {
  CHECK(is_own_file("labs/02_pi/pi.cpp"));
  CHECK(is_own_file("labs/08_path_tracer/steps/a_camera.cpp"));
  CHECK_FALSE(is_own_file("labs/02_pi/main.cpp"));
  CHECK_FALSE(is_own_file("labs/02_pi/pi.h"));
  CHECK_FALSE(is_own_file("solutions/02_pi/pi.cpp"));
}

TEST_CASE("errors in the student's file come first, those it caused elsewhere next", "[course]") {
  const std::string log =
      "[1/2] Building CXX object x.o\n"
      "FAILED: x.o\n"
      "In file included from /tree/labs/02_pi/pi.cpp:1:\n"
      "/tree/labs/02_pi/pi.h:7:3: error: 'Foo' does not name a type\n"
      "    7 |   Foo foo;\n      |   ^~~\n"
      "In file included from /usr/include/c++/12/algorithm:61,\n"
      "                 from /tree/labs/02_pi/pi.cpp:3:\n"
      "/usr/include/c++/12/bits/stl_algo.h: In instantiation of 'void std::sort(It, It)':\n"
      "/tree/labs/02_pi/pi.cpp:30:12:   required from here\n"
      "/usr/include/c++/12/bits/stl_algo.h:1900:5: error: no match for 'operator-' (operand types "
      "are 'std::__cxx11::basic_string<char>' and 'std::vector<int, std::allocator<int> >')\n"
      " 1900 |   x - y\n      |   ^\n"
      "../../labs/02_pi/pi.cpp:12:5: warning: unused variable 'x' [-Wunused-variable]\n"
      "/tree/labs/02_pi/pi.cpp: In function 'int lab02::f()':\n"
      "../../labs/02_pi/pi.cpp:20:10: error: 'y' was not declared in this scope\n"
      "   20 |   return y;\n      |          ^\n"
      "../../labs/02_pi/pi.cpp:20:10: note: suggested alternative: 'z'\n"
      "   20 |   return y;\n      |          ^\n      |          z\n"
      "../../labs/02_pi/pi.cpp:20:10: error: 'y' was not declared in this scope\n";
  const std::vector<CompilerMessage> messages = compiler_messages(log, "/tree");
  REQUIRE(messages.size() == 4);
  CHECK(messages[0].whose == CompilerMessage::Whose::own);
  CHECK(messages[0].file == "labs/02_pi/pi.cpp");
  CHECK(messages[0].line == 20);
  CHECK(messages[0].column == 10);
  CHECK(messages[0].excerpt.size() == 2);
  CHECK(messages[1].whose == CompilerMessage::Whose::caused);
  CHECK(messages[1].line == 30);
  CHECK(messages[1].found_in == "/usr/include/c++/12/bits/stl_algo.h:1900");
  CHECK(has(messages[1].text, "'std::string' and 'std::vector<int>'"));
  CHECK(messages[2].file == "labs/02_pi/pi.h");
  CHECK_FALSE(messages[3].error);
  const std::string text = compiler_text(messages, 1);
  CHECK(text.rfind("labs/02_pi/pi.cpp:20:10: error: 'y' was not declared", 0) == 0);
  CHECK(has(text, "and 2 more errors\n"));
}

TEST_CASE("a missing } is explained once, where the next function begins", "[course]") {
  const std::string gcc =
      "../../labs/02_pi/pi.cpp: In function 'double lab02::f()':\n"
      "../../labs/02_pi/pi.cpp:21:9: error: a function-definition is not allowed here before '{' "
      "token\n   21 | double g() {\n      |            ^\n"
      "../../labs/02_pi/pi.cpp:29:18: error: qualified-id in declaration before '(' token\n"
      "../../labs/02_pi/pi.cpp:33:5: error: 'y' was not declared in this scope\n"
      "../../labs/02_pi/pi.cpp:45:2: error: expected '}' at end of input\n";
  const std::vector<CompilerMessage> messages = compiler_messages(gcc, "/tree");
  REQUIRE(messages.size() == 2);
  CHECK(messages[0].line == 21);
  CHECK(has(messages[0].text, "a } is missing"));
  CHECK(messages[0].excerpt.size() == 2);
  CHECK(messages[1].line == 33);  // a separate error
  const std::string clang =
      "/tree/labs/02_pi/pi.cpp:21:12: error: function definition is not allowed here\n"
      "/tree/labs/02_pi/pi.cpp:45:2: error: expected '}'\n";
  REQUIRE(compiler_messages(clang, "/tree").size() == 1);
  CHECK(has(compiler_messages(clang, "/tree")[0].text, "a } is missing"));
}

TEST_CASE("of a function of <cmath> the header is named, of a member of another class not",
          "[course]") {
  const auto explained = [](const std::string& text) {
    return compiler_messages("/tree/labs/02_pi/pi.cpp:5:9: error: " + text + "\n", "/tree")
        .at(0)
        .text;
  };
  const std::string missing = "std::sqrt is not known here: #include <cmath>";
  CHECK(explained("'sqrt' is not a member of 'std'; did you mean 'sort'?") == missing);
  CHECK(explained("‘sqrt’ is not a member of ‘std’; did you mean ‘sort’?") == missing);
  CHECK(explained("no member named 'sqrt' in namespace 'std'; did you mean 'sort'?") == missing);
  for (const char* other :
       {"'struct Point' has no member named 'log'", "'sort' is not a member of 'std'",
        "'log' is not a member of 'std::chrono'", "no member named 'exp' in 'lab02::Sums'"})
    CHECK(explained(other) == other);
}

TEST_CASE("a missing return is explained before other warnings", "[course]") {
  const std::string log =
      "/tree/labs/02_pi/pi.cpp:5:9: warning: unused variable 'x' [-Wunused-variable]\n"
      "/tree/labs/02_pi/pi.cpp:9:1: warning: no return statement in function returning non-void "
      "[-Wreturn-type]\n";
  const std::vector<CompilerMessage> messages = compiler_messages(log, "/tree");
  REQUIRE(messages.size() == 2);
  CHECK(messages[0].line == 9);
}

TEST_CASE("Clang's way to the student's line, and what the linker misses", "[course]") {
  const std::string log =
      "/usr/include/c++/12/bits/stl_algo.h:10:5: error: invalid operands to binary expression\n"
      "    x - y\n    ~ ^ ~\n"
      "/tree/labs/02_pi/pi.cpp:30:12: note: in instantiation of function template specialization "
      "'std::sort<It>' requested here\n"
      "/usr/bin/ld: probes.cpp.o: in function `probe':\n"
      "probes.cpp:(.text+0x1): undefined reference to `lab02::pi_estimate(lab02::Darts const&)'\n"
      "ld.lld: error: undefined symbol: lab02::mean_of(lab02::Sums const&)\n";
  const std::vector<CompilerMessage> messages = compiler_messages(log, "/tree");
  REQUIRE(messages.size() == 3);
  CHECK(messages[0].file == "labs/02_pi/pi.cpp");
  CHECK(messages[0].line == 30);
  CHECK(
      has(messages[1].text, "lab02::pi_estimate(lab02::Darts const&) is called but never defined"));
  CHECK(has(messages[2].text, "lab02::mean_of(lab02::Sums const&) is called but never defined"));
}

TEST_CASE("a parallel algorithm of the library, which lacks its library, is told once",
          "[course]") {
  const std::string log =
      "/usr/bin/ld: integration.cpp.o: in function `lab01::average(long)':\n"
      "integration.cpp:(.text+0x1): undefined reference to `tbb::detail::r1::destroy(int&)'\n"
      "integration.cpp:(.text+0x2): undefined reference to `tbb::detail::r1::isolate(long)'\n";
  const std::vector<CompilerMessage> messages = compiler_messages(log, "/tree");
  REQUIRE(messages.size() == 1);
  CHECK(has(messages[0].text, "std::execution::par needs the library TBB"));
}

TEST_CASE("a log in which nothing is recognised is shown without the commands", "[course]") {
  const std::string log = "FAILED: x\n/usr/bin/c++ -c x.cpp\nc++: fatal: killed\nninja: stopped\n";
  CHECK(compiler_messages(log, "/tree").empty());
  CHECK(plain_log(log, 10) == "c++: fatal: killed\n");
  CHECK(plain_log("a\nb\nc\n", 2) == "b\nc\n");
}

TEST_CASE("long lines go on below, indented; colours take no room", "[course]") {
  CHECK(wrapped_to("    one two three four five six", 20) ==
        "    one two three\n    four five six\n");
  CHECK(wrapped_to("\x1b[31mred\x1b[0m and that is it", 20) ==
        "\x1b[31mred\x1b[0m and that is it\n");
  CHECK(wrapped_to(std::string(45, 'x'), 20) ==
        std::string(20, 'x') + "\n" + std::string(20, 'x') + "\n" + std::string(5, 'x') + "\n");
  CHECK(first_rows("a\nb\nc\nd\n", 3, "press v") == "a\nb\n... 2 more lines: press v\n");
  CHECK(wrapped("a prompt: ", 20) == "a prompt: ");
  CHECK(wrapped("one two three four five six: ", 20) == "one two three four\nfive six: ");
  CHECK(first_rows("a\nb\n", 3, "press v") == "a\nb\n");
}
