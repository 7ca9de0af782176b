#include "grader/grade/compile.h"

#include "grader/grade/compilation.h"
#include "grader/grade/own_names.h"
#include "support/error.h"
#include "support/wall_clock.h"

#include <algorithm>
#include <optional>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// Returns the path of an exercise file's object, without the '/' in its name.
fs::path object_of(const fs::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return folder / (name + ".o");
}

std::vector<fs::path> paths(const Objects& objects) {
  std::vector<fs::path> list;
  for (const auto& [name, object] : objects)
    list.push_back(object);
  return list;
}

/// The compilations of one lab of a submission. Time that the student's files take is not taken
/// from ours, nor from their second trials.
struct Trials {
  Compilation first, ours, again;

  /// Returns whether an operation on the student's files works. `work` does it, `control` does the
  /// like with the course's own files, and throws if that fails: then the student is not to blame.
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

/// Compiles and links the course's own files. If that fails the student is not to blame.
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

/// Makes names that several files define local to each. `ours` compiles the stubs only if there is
/// a conflict.
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
    ours.change_symbols(objects.at(name), "--redefine-syms", redefinitions(list, name));
  result.own_names = own_names_text(names);
}

/// Compiles the course's own text of one file. Throws Error.
void make_stub(Compilation& ours, const std::string& name, const std::string& text,
               const fs::path& object) {
  std::string said;  // its warnings do not concern the student
  if (!ours.make(name, text, object, said)) throw Error("{}", no_stub(said));
}

/// Links as many of the student's files as fit together, the first ones first, with stubs for the
/// others.
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

/// Compiles the files that were handed in, with stubs for those that were not, or that do not
/// compile. Returns nothing if that is the lab's only file.
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

std::optional<Objects> compile_objects(const std::map<std::string, std::string>& files,
                                       const LabTools& tools, const Sandbox& sandbox,
                                       const Folders& folders,
                                       const std::vector<std::string>& flags) {
  const Compilation fresh(tools, sandbox, folders.theirs, flags);
  Trials trials{fresh, fresh, fresh};
  Compiled unsaid;
  std::optional<Objects> objects = make_objects(trials, files, tools, folders.ours, unsaid);
  if (objects && tools.stubs.size() > 1)
    settle_names(trials.ours, tools, folders.ours, *objects, unsaid);
  return objects;
}

Compiled compile(const std::map<std::string, std::string>& files, const LabTools& tools,
                 const Sandbox& sandbox, const Folders& folders, const fs::path& worker) {
  const WallClock clock;
  const Compilation fresh(tools, sandbox, folders.theirs);
  Trials trials{fresh, fresh, fresh};
  Compiled result;
  const std::optional<Objects> objects = make_objects(trials, files, tools, folders.ours, result);
  if (objects) {
    if (tools.stubs.size() > 1) settle_names(trials.ours, tools, folders.ours, *objects, result);
    link_all(trials, *objects, tools, folders.ours, worker, result);
  }
  result.seconds = clock.seconds();
  result.peak_bytes =
      std::max({trials.first.peak_bytes(), trials.ours.peak_bytes(), trials.again.peak_bytes()});
  return result;
}

}  // namespace carlo::grader
