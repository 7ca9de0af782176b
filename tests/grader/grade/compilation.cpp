#include "grader/grade/compilation.h"

#include "course/cli/descriptor.h"
#include "course/guide/compiler_messages.h"
#include "course/verdict/printed.h"
#include "grader/grade/blame.h"
#include "grader/grade/precompiled_header.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <sstream>
#include <system_error>
#include <utility>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr fs::perms readable_by_all =
    fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read | fs::perms::others_read;
constexpr fs::perms runnable =
    readable_by_all | fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;

/// The time for one file, and for all files of a lab including linking: the machine may be busy
/// with others.
constexpr std::chrono::milliseconds file_budget = std::chrono::minutes(3),
                                    lab_budget = std::chrono::minutes(5);

Limits compile_limits() {
  Limits limits;
  limits.deadline = file_budget;
  limits.cpu = std::chrono::seconds(60);
  limits.memory_bytes = std::size_t{1536} << 20;
  limits.file_bytes = std::size_t{64} << 20;
  limits.processes = 64;
  limits.output_kept = std::size_t{16} << 10;
  return limits;
}

/// A folder that the sandbox may write into; removed with this object.
class WorkFolder {
 public:
  explicit WorkFolder(fs::path path) : path_(std::move(path)) {
    fs::remove_all(path_);
    fs::create_directory(path_);
    fs::permissions(path_, fs::perms::owner_all);
  }
  ~WorkFolder() {
    std::error_code ec;
    fs::remove_all(path_, ec);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Moves a file out of a folder that was the sandbox's, if it is as expected: a regular file that
/// begins with ELF's magic number. Does not follow a link in its place.
bool take_elf(const fs::path& from, const fs::path& to, fs::perms permissions) {
  const Descriptor file(::open(from.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!file.open() || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t got = ::read(file.get(), bytes.data() + have, bytes.size() - have);
    if (got <= 0) return false;
    have += static_cast<std::size_t>(got);
  }
  if (!bytes.starts_with("\x7F"
                         "ELF"))
    return false;
  write_file(to, bytes);
  fs::permissions(to, permissions);
  return true;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// Compilers quote what students wrote, control characters included.
void add_harmless(std::string& messages, const std::string& said) {
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);)
    messages += harmless(line) + "\n";
}

/// Says in a line each, as ./carlo test does, what the linker found missing or twice: its own words
/// name our files, and a name that is missing in each place that uses it.
std::string in_plain_words(const std::string& said) {
  constexpr std::size_t most = 3;
  std::string text;
  const std::vector<CompilerMessage> messages = compiler_messages(said, {});
  for (std::size_t i = 0; i < std::min(messages.size(), most); ++i)
    text += messages[i].text + "\n";
  return text;
}

/// Says, for the student, why a compiler was ended; "" if it ended by itself.
std::string cut_short(const Outcome& outcome) {
  using End = Outcome::End;
  switch (outcome.end) {
    case End::deadline:
      return "the compiler was not done in time";
    case End::flooded_output:
      return "the compiler printed without end";
    case End::flooded_disk:
      return "the compiler filled the disk";
    case End::flooded_memory:
      return "the compiler took too much memory";
    case End::flooded_processes:
      return "the compiler started too many processes";
    case End::signalled:
      return "the compiler was ended: " + signal_name(outcome.code);
    default:
      return outcome.succeeded() || !outcome.output.empty() ? "" : "the compiler failed";
  }
}

bool has_ending(const std::string& text, const std::string& ending) {
  return text.find(ending) != std::string::npos;
}

/// Returns whether nm failed because of its input and not because of the machine.
bool is_of_the_object(const Outcome& outcome) {
  using End = Outcome::End;
  if (outcome.end == End::exited) {
    return !tells_of_the_machine(outcome.output, outcome.peak_bytes, compile_limits().memory_bytes);
  }
  return outcome.end == End::flooded_output || outcome.end == End::flooded_memory;
}

}  // namespace

std::vector<std::string> compile_command(const LabTools& tools) {
  std::vector<std::string> argv{tools.recipe.compiler};
  argv.insert(argv.end(), tools.recipe.flags.begin(), tools.recipe.flags.end());
  for (const fs::path& include : tools.recipe.includes)
    argv.push_back("-I" + include.string());
  argv.insert(argv.end(), {"-fno-lto", "-fdiagnostics-color=never"});
  // Keeps our paths out of what the program prints (__FILE__, an assertion).
  for (const fs::path& header : tools.headers)
    argv.push_back("-ffile-prefix-map=" + header.string() + "/=");
  return argv;
}

Compilation::Compilation(const LabTools& tools, const Sandbox& sandbox, const fs::path& folder,
                         std::vector<std::string> flags)
    : tools_(tools),
      sandbox_(sandbox),
      folder_(folder),
      flags_(std::move(flags)),
      left_(lab_budget) {}

bool Compilation::make(const std::string& name, const std::string& text, const fs::path& object,
                       std::string& messages) {
  return compile(name, text, object, messages) && keeps_apart(name, object, messages);
}

bool Compilation::compile(const std::string& name, const std::string& text, const fs::path& object,
                          std::string& messages) {
  const WorkFolder work(folder_ / "compile");
  const fs::path source = work.path() / name;
  if (source.parent_path() != work.path()) {
    fs::create_directory(source.parent_path());
    fs::permissions(source.parent_path(),
                    fs::perms::owner_all | fs::perms::others_exec | fs::perms::others_read);
  }
  write_file(source, text);
  fs::permissions(source, readable_by_all);
  const std::string ahead = header_ahead(tools_, text);
  Outcome outcome = compile_in(work.path(), source, ahead);
  // The students' compiler reads the header in its place, and has the last word.
  if (!ahead.empty() && outcome.end == Outcome::End::exited && outcome.code != 0)
    outcome = compile_in(work.path(), source, {});
  std::string said = outcome.output;
  if (!cut_short(outcome).empty()) said += cut_short(outcome) + "\n";
  replace_all(said, work.path().string() + "/", "");
  for (const fs::path& header : tools_.headers)
    replace_all(said, header.string() + "/", "");
  add_harmless(messages, said);
  return outcome.succeeded() && take_elf(work.path() / "exercise.o", object, readable_by_all);
}

Outcome Compilation::compile_in(const fs::path& work, const fs::path& source,
                                const std::string& ahead) {
  std::vector<std::string> argv = compile_command(tools_);
  argv.insert(argv.end(), flags_.begin(), flags_.end());
  argv.push_back("-ffile-prefix-map=" + work.string() + "/=");
  if (!ahead.empty()) argv.insert(argv.end(), {"-include", ahead});
  argv.insert(argv.end(), {"-o", "exercise.o", "-c", source.string()});
  return run(argv, {tools_.headers, work});
}

bool Compilation::keeps_apart(const std::string& name, const fs::path& object,
                              std::string& messages) {
  if (ours_.empty()) {
    for (const Recipe::Word& word : tools_.recipe.link) {
      if (!word.file || has_ending(word.text, ".so")) continue;
      const Outcome outcome = symbols_in(word.text);
      if (!outcome.succeeded()) throw Error("nm cannot read {}", word.text);
      add_symbols(ours_, outcome.output);
    }
  }
  const Outcome outcome = symbols_in(object);
  std::string why = "it defines too many names, or such as cannot be read";
  if (outcome.succeeded()) {
    Symbols exercise;
    add_symbols(exercise, outcome.output);
    why = foreign_symbols(exercise, ours_, tools_.name_space);
  } else if (!is_of_the_object(outcome)) {
    throw Error("nm cannot read {}", object.string());
  }
  if (!why.empty()) messages += fmt::format("{}: {}\n", name, why);
  return why.empty();
}

Symbols Compilation::symbols_of(const fs::path& object) {
  const Outcome outcome = symbols_in(object);
  // It was readable before (keeps_apart()).
  if (!outcome.succeeded()) throw Error("nm cannot read {}", object.string());
  Symbols symbols;
  add_symbols(symbols, outcome.output);
  return symbols;
}

void Compilation::change_symbols(const fs::path& object, const std::string& option,
                                 const std::string& lines) {
  if (lines.empty()) return;
  const WorkFolder work(folder_ / "symbols");
  write_file(work.path() / "names.txt", lines);
  fs::permissions(work.path() / "names.txt", readable_by_all);
  const fs::path changed = work.path() / "changed.o";
  const Outcome outcome =
      run({"/usr/bin/objcopy", option + "=" + (work.path() / "names.txt").string(), object.string(),
           changed.string()},
          {{object}, work.path()});
  // An object that was readable before has names that can be replaced.
  if (!outcome.succeeded() || !take_elf(changed, object, readable_by_all)) {
    throw Error("objcopy cannot change the symbols of {}: {}", object.string(),
                outcome.output.substr(0, 300));
  }
}

bool Compilation::link(const std::vector<fs::path>& objects, const fs::path& worker,
                       std::string& messages) {
  const WorkFolder work(folder_ / "link");
  std::vector<std::string> argv{tools_.recipe.compiler, "-fno-lto", "-fno-use-linker-plugin"};
  argv.insert(argv.end(), flags_.begin(), flags_.end());
  for (std::size_t i = 0; i <= tools_.recipe.link.size(); ++i) {
    if (i == tools_.recipe.objects_at) argv.insert(argv.end(), objects.begin(), objects.end());
    if (i < tools_.recipe.link.size()) argv.push_back(tools_.recipe.link[i].text);
  }
  argv.insert(argv.end(), {"-o", "worker"});
  View view{tools_.inputs, work.path()};
  view.readable.insert(view.readable.end(), objects.begin(), objects.end());
  const Outcome outcome = run(argv, view);
  std::string said = outcome.output;
  if (!cut_short(outcome).empty()) said += cut_short(outcome) + "\n";
  for (const fs::path& object : objects)
    replace_all(said, object.parent_path().string() + "/", "");
  for (const fs::path& input : tools_.inputs)
    replace_all(said, input.parent_path().string() + "/", "");
  if (!outcome.succeeded()) said = in_plain_words(said) + said;
  add_harmless(messages, said);
  return outcome.succeeded() && take_elf(work.path() / "worker", worker, runnable);
}

Outcome Compilation::symbols_in(const fs::path& file) {
  const WorkFolder work(folder_ / "symbols");
  Limits limits = compile_limits();
  limits.output_bytes = limits.output_kept = std::size_t{32} << 20;
  return sandbox_.run(
      {"/usr/bin/nm", "--plugin=/dev/null", "--extern-only", "--format=posix", file.string()},
      {{file}, work.path()}, limits);
}

Outcome Compilation::run(const std::vector<std::string>& argv, const View& view) {
  Outcome outcome;
  outcome.end = Outcome::End::deadline;
  if (left_.count() <= 0) return outcome;
  Limits limits = compile_limits();
  limits.deadline = std::min(limits.deadline, left_);
  outcome = sandbox_.run(argv, view, limits);
  left_ -= std::chrono::milliseconds(
      static_cast<std::int64_t>(1000 * (outcome.seconds - outcome.waited)));
  peak_ = std::max(peak_, outcome.peak_bytes);
  // Exceeding its own processor time gives a compiler another signal.
  const bool killed = outcome.end == Outcome::End::signalled && outcome.code == SIGKILL;
  const bool tells = tells_of_the_machine(outcome.output, outcome.peak_bytes, limits.memory_bytes);
  in_doubt_ = !outcome.succeeded() && (killed || tells);
  return outcome;
}

}  // namespace carlo::grader
