// carlo_keep: notes what the judge said for ./carlo status. A program of its own, because a first
// verdict waits for it to be compiled, and need not wait for hints and the compiler's messages
// (carlo_course).

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/guide/verdicts.h"
#include "course/verdict/verdict_json.h"
#include "support/atomic_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace carlo;

int main(int argc, char** argv) {
  return run_main([&] {
    fs::path root = ".";
    std::string file;
    int number = 0;
    CommandLine app("Notes the judge's verdicts of a lab", "carlo_keep");
    app.option("--root", root, "the folder of the tree").show_default();
    app.option("lab", number, "which lab").required();
    app.option("verdicts", file, "the file of the judge's --json").required();
    if (const auto code = app.parse(argc, argv)) return *code;

    const std::vector<Lab> labs = load_labs(root / "labs");
    const Lab& lab = find_lab(labs, number);
    VerdictBook book(root / ".carlo" / "verdicts.json");
    book.take(lab_result_from_text(read_file(file)), lab, OwnCode(root / "labs", lab));
    book.save();
    return 0;
  });
}
