#include "grader/grade/compile.h"

#include "cli/atomic_file.h"
#include "cli/descriptor.h"
#include "cli/error.h"
#include "grader/grade/blame.h"
#include "grader/grade/foreign_symbols.h"
#include "grader/grade/own_names.h"
#include "grader/judge/printed.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// What one file may take, and all files of a lab together with their linking: the machine may be
/// busy with others.
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

/// A folder that is the sandbox's to write into; it goes with this object.
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

/// Takes a file out of a folder that was the sandbox's, when it is what it should be: a regular
/// file that begins with ELF's mark. A link in its place is not followed.
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

/// Compilers quote what students wrote: control characters too.
void add_harmless(std::string& messages, const std::string& said) {
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);)
    messages += harmless(line) + "\n";
}

/// Why a compiler was ended, for the student; "" when it ended itself.
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
    case End::signalled:
      return "the compiler was ended: " + signal_name(outcome.code);
    default:
      return outcome.succeeded() || !outcome.output.empty() ? "" : "the compiler failed";
  }
}

/// One lab's compilation: everything that stays the same from file to file, and the time that is
/// left for all of them.
class Compilation {
 public:
  Compilation(const LabTools& tools, const Sandbox& sandbox, const fs::path& folder)
      : tools_(tools), sandbox_(sandbox), folder_(folder) {}

  /// Compiles one file to `object`, which keeps to itself. False when it does not compile, or
  /// would put itself in the place of our code.
  bool make(const std::string& name, const std::string& text, const fs::path& object,
            std::string& messages) {
    return compile(name, text, object, messages) && keeps_apart(name, object, messages);
  }

  /// Whether what failed last may have failed because of the machine.
  bool in_doubt() const { return in_doubt_; }

  /// Compiles one file to `object`. False when it does not compile.
  bool compile(const std::string& name, const std::string& text, const fs::path& object,
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
    std::vector<std::string> argv{tools_.recipe.compiler};
    argv.insert(argv.end(), tools_.recipe.flags.begin(), tools_.recipe.flags.end());
    for (const fs::path& include : tools_.recipe.includes)
      argv.push_back("-I" + include.string());
    for (const char* flag : {"-fno-lto", "-fdiagnostics-color=never", "-o", "exercise.o", "-c"})
      argv.emplace_back(flag);
    // What the program prints of itself (__FILE__, an assertion) tells no path of ours.
    argv.push_back("-ffile-prefix-map=" + work.path().string() + "/=");
    for (const fs::path& header : tools_.headers)
      argv.push_back("-ffile-prefix-map=" + header.string() + "/=");
    argv.push_back(source.string());
    const Outcome outcome = run(argv, {tools_.headers, work.path()});
    std::string said = outcome.output;
    if (!cut_short(outcome).empty()) said += cut_short(outcome) + "\n";
    replace_all(said, work.path().string() + "/", "");
    for (const fs::path& header : tools_.headers)
      replace_all(said, header.string() + "/", "");
    add_harmless(messages, said);
    return outcome.succeeded() && take_elf(work.path() / "exercise.o", object, readable_by_all);
  }

  /// False, and says why, when an object would put itself in the place of our code or calls into
  /// it.
  bool keeps_apart(const std::string& name, const fs::path& object, std::string& messages) {
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

  /// The symbols of an object; none where nm cannot read it.
  Symbols symbols_of(const fs::path& object) {
    const Outcome outcome = symbols_in(object);
    Symbols symbols;
    if (outcome.succeeded()) add_symbols(symbols, outcome.output);
    return symbols;
  }

  /// Gives names of an object new ones. Where that fails it stays as it is, and the linker has the
  /// last word.
  void rename(const fs::path& object, const std::string& redefinitions) {
    const WorkFolder work(folder_ / "rename");
    write_file(work.path() / "names.txt", redefinitions);
    fs::permissions(work.path() / "names.txt", readable_by_all);
    const fs::path renamed = work.path() / "renamed.o";
    const Outcome outcome =
        run({"/usr/bin/objcopy", "--redefine-syms=" + (work.path() / "names.txt").string(),
             object.string(), renamed.string()},
            {{object}, work.path()});
    if (outcome.succeeded()) take_elf(renamed, object, readable_by_all);
  }

  /// Links objects into `worker`. The flags keep the linker from running plugins on what students'
  /// objects hold.
  bool link(const std::vector<fs::path>& objects, const fs::path& worker, std::string& messages) {
    const WorkFolder work(folder_ / "link");
    std::vector<std::string> argv{tools_.recipe.compiler, "-fno-lto", "-fno-use-linker-plugin"};
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
    add_harmless(messages, said);
    return outcome.succeeded() && take_elf(work.path() / "worker", worker, runnable);
  }

  std::size_t peak_bytes() const { return peak_; }

 private:
  static constexpr fs::perms readable_by_all = fs::perms::owner_read | fs::perms::owner_write |
                                               fs::perms::group_read | fs::perms::others_read;
  static constexpr fs::perms runnable =
      readable_by_all | fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;

  static bool has_ending(const std::string& text, const std::string& ending) {
    return text.find(ending) != std::string::npos;
  }

  /// Whether what was read, and not the machine, is why nm failed.
  static bool is_of_the_object(const Outcome& outcome) {
    using End = Outcome::End;
    return outcome.end == End::flooded_output || outcome.end == End::flooded_memory ||
           outcome.end == End::exited;
  }

  /// nm's list of an object or archive. Without plugin: that of a link-time optimiser believes what
  /// an object says of itself in a section of its own, and looks no further.
  Outcome symbols_in(const fs::path& file) {
    const WorkFolder work(folder_ / "symbols");
    Limits limits = compile_limits();
    limits.output_bytes = limits.output_kept = std::size_t{32} << 20;
    return sandbox_.run(
        {"/usr/bin/nm", "--plugin=/dev/null", "--extern-only", "--format=posix", file.string()},
        {{file}, work.path()}, limits);
  }

  /// A compiler or linker, as long as the lab's time lasts.
  Outcome run(const std::vector<std::string>& argv, const View& view) {
    Outcome outcome;
    outcome.end = Outcome::End::deadline;
    if (left_.count() <= 0) return outcome;
    Limits limits = compile_limits();
    limits.deadline = std::min(limits.deadline, left_);
    outcome = sandbox_.run(argv, view, limits);
    left_ -= std::chrono::milliseconds(
        static_cast<std::int64_t>(1000 * (outcome.seconds - outcome.waited)));
    peak_ = std::max(peak_, outcome.peak_bytes);
    // Over its own processor time a compiler gets another signal.
    const bool killed = outcome.end == Outcome::End::signalled && outcome.code == SIGKILL;
    const bool tells =
        tells_of_the_machine(outcome.output, outcome.peak_bytes, limits.memory_bytes);
    in_doubt_ = !outcome.succeeded() && (killed || tells);
    return outcome;
  }

  const LabTools& tools_;
  const Sandbox& sandbox_;
  fs::path folder_;
  Symbols ours_;  ///< of all that is linked but the exercises
  std::chrono::milliseconds left_ = lab_budget;
  std::size_t peak_ = 0;
  bool in_doubt_ = false;
};

/// The object of an exercise file; '/' has no place in its name.
fs::path object_of(const fs::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return folder / (name + ".o");
}

using Objects = std::map<std::string, fs::path>;  // by file

std::vector<fs::path> paths(const Objects& objects) {
  std::vector<fs::path> list;
  for (const auto& [name, object] : objects)
    list.push_back(object);
  return list;
}

/// The compilations of one lab of a submission. What takes the student's files' time takes none of
/// ours, and none of their second trials.
struct Trials {
  Compilation first, ours, again;

  /// Whether something of the student's works. `work` does it, `control` does the like with what
  /// the course gives, and throws where that fails: then the student is not to blame.
  template <class Work, class Control>
  bool succeed(const Work& work, const Control& control, std::string& messages) {
    std::string said;
    bool good = work(first, said);
    if (!good) {
      control();
      said.clear();
      good = work(again, said);
      if (!good && again.in_doubt()) throw Error("{}", doubt(said));
    }
    messages += said;
    return good;
  }

 private:
  static std::string doubt(const std::string& said) {
    const std::string line = said.substr(0, said.rfind('\n'));
    return "the compiler may have failed for the machine's sake: " +
           line.substr(line.rfind('\n') + 1).substr(0, 300);
  }
};

std::string no_stub(const std::string& messages) {
  return "not even the stub can be built in the sandbox: " +
         messages.substr(0, messages.find('\n'));
}

void link_stubs(Compilation& ours, const Objects& stubs, const fs::path& worker) {
  std::string said;
  if (!ours.link(paths(stubs), worker, said)) throw Error("{}", no_stub(said));
}

/// Compiles and links what the course itself gives. When that fails the student is not to blame.
Objects check_with_stubs(Compilation& compilation, const LabTools& tools, const fs::path& folder) {
  std::string messages;
  Objects objects;
  bool good = true;
  for (const auto& [name, text] : tools.stubs) {
    objects[name] = object_of(folder, "stub_" + name);
    good = good && compilation.make(name, text, objects[name], messages);
  }
  if (!good) throw Error("{}", no_stub(messages));
  link_stubs(compilation, objects, folder / "stub_worker");
  return objects;
}

/// Makes names that several files define each file's own. The stubs are compiled, by `ours`, only
/// where there is something to settle.
void settle_names(Compilation& ours, const LabTools& tools, const fs::path& folder,
                  const Objects& objects, Compiled& result) {
  std::map<std::string, Symbols> symbols, stubs;
  for (const auto& [name, object] : objects)
    symbols[name] = ours.symbols_of(object);
  if (own_names(symbols, {}).empty()) return;
  for (const auto& [name, object] : check_with_stubs(ours, tools, folder))
    stubs[name] = ours.symbols_of(object);
  const NewNames names = own_names(symbols, stubs);
  for (const auto& [name, list] : names)
    ours.rename(objects.at(name), redefinitions(list, name));
  result.own_names = own_names_text(names);
}

/// Compiles the course's own text of one file. Throws Error.
void make_stub(Compilation& ours, const std::string& name, const std::string& text,
               const fs::path& object) {
  std::string said;  // its warnings are no news for the student
  if (!ours.make(name, text, object, said)) throw Error("{}", no_stub(said));
}

/// Links as many of the student's files as go together, the first ones first, with stubs in the
/// place of the others.
void link_what_fits(Trials& trials, const Objects& stubs, const Objects& objects,
                    const fs::path& worker, Compiled& result) {
  Objects fitting = stubs;
  const auto links = [&](const Objects& tried, std::string& messages) {
    return trials.succeed([&](Compilation& trial,
                              std::string& said) { return trial.link(paths(tried), worker, said); },
                          [&] { link_stubs(trials.ours, stubs, worker); }, messages);
  };
  for (const auto& [name, object] : objects) {
    Objects tried = fitting;
    tried[name] = object;
    std::string said;
    if (links(tried, said)) {
      fitting = tried;
    } else {
      result.misfits.push_back(name);
      result.messages += said;
    }
  }
  std::string said;
  result.linked = links(fitting, said);
}

/// Compiles the files that were handed in, and stubs in the place of those that were not, or that
/// do not compile. Of a lab that has one file there is nothing then.
std::optional<Objects> make_objects(Trials& trials, const std::map<std::string, std::string>& files,
                                    const LabTools& tools, const fs::path& folder,
                                    Compiled& result) {
  Objects objects;
  for (const auto& [name, stub] : tools.stubs) {
    const fs::path object = objects[name] = object_of(folder, name);
    const auto given = files.find(name);
    const auto stub_too = [&, &file = name, &text = stub] {
      make_stub(trials.ours, file, text, object_of(folder, "stub_" + file));
    };
    if (given != files.end()) {
      const bool good = trials.succeed(
          [&](Compilation& trial, std::string& said) {
            return trial.make(given->first, given->second, object, said);
          },
          stub_too, result.messages);
      if (good) continue;
      result.refused.push_back(name);
    }
    if (tools.stubs.size() == 1) return {};
    make_stub(trials.ours, name, stub, object);
  }
  return objects;
}

void link_all(Trials& trials, const Objects& objects, const LabTools& tools, const fs::path& folder,
              const fs::path& worker, Compiled& result) {
  Objects stubs;
  std::string said;
  result.linked =
      trials.succeed([&](Compilation& trial,
                         std::string& words) { return trial.link(paths(objects), worker, words); },
                     [&] { stubs = check_with_stubs(trials.ours, tools, folder); }, said);
  if (!result.linked && tools.stubs.size() > 1) {
    link_what_fits(trials, stubs, objects, worker, result);
  } else {
    result.messages += said;
  }
}

}  // namespace

Compiled compile(const std::map<std::string, std::string>& files, const LabTools& tools,
                 const Sandbox& sandbox, const Folders& folders, const fs::path& worker) {
  const auto start = std::chrono::steady_clock::now();
  const Compilation fresh(tools, sandbox, folders.theirs);
  Trials trials{fresh, fresh, fresh};
  Compiled result;
  const std::optional<Objects> objects = make_objects(trials, files, tools, folders.ours, result);
  if (objects) {
    if (tools.stubs.size() > 1) settle_names(trials.ours, tools, folders.ours, *objects, result);
    link_all(trials, *objects, tools, folders.ours, worker, result);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.peak_bytes =
      std::max({trials.first.peak_bytes(), trials.ours.peak_bytes(), trials.again.peak_bytes()});
  return result;
}

}  // namespace carlo::grader
