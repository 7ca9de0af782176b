// The worker: one lab's probes linked with one implementation. Runs one probe and sends its result
// as one frame. It judges nothing and writes no file.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/cli/wrap.h"
#include "course/not_implemented.h"
#include "grader/protocol/rows_text.h"
#include "grader/worker/full_stack.h"
#include "grader/worker/probe.h"
#include "support/error.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace carlo::grader {
namespace {

Frame run(Probe probe, const Params& params) {
  Frame frame;
  try {
    frame.rows = probe(params);
  } catch (const NotImplemented& error) {
    frame.status = Frame::Status::not_implemented;
    frame.text = error.what();
    frame.tag = error.tag();
    frame.function = error.function();
  } catch (const std::bad_alloc&) {
    frame.status = Frame::Status::error;
    frame.text = "out of memory (std::bad_alloc)";
  } catch (const std::system_error& error) {
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    frame.status = no_thread ? Frame::Status::exhausted : Frame::Status::error;
    frame.text = error.what();
  } catch (const std::exception& error) {
    frame.status = Frame::Status::error;
    frame.text = error.what();
  } catch (...) {
    frame.status = Frame::Status::error;
    frame.text = "something that is no std::exception";
  }
  return frame;
}

/// Prints the frame for people: its first `most` rows (all for 0). Only a table is a success.
int print(const Frame& frame, const NamedProbe& probe, std::size_t most) {
  if (frame.status != Frame::Status::rows) {
    fmt::print("no values: {}{}\n", frame.text,
               frame.function.empty() ? "" : ", in " + frame.function);
    return 1;
  }
  fmt::print("{}", rows_text(frame.rows, probe.names, most));
  if (!probe.remark.empty()) fmt::print("{}", wrapped(probe.remark + "\n", 80));
  return 0;
}

void send(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw Error("cannot send the values: {}", std::strerror(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

int main(int argc, char** argv) {
  CommandLine app("A lab's worker");
  std::string name;
  std::string text = to_text({});
  int fd = STDOUT_FILENO;
  bool list = false;
  std::size_t rows = 0;
  std::vector<std::size_t> shape;
  app.option("--probe", name, "the probe to run");
  app.option("--params", text, "its parameters, such as \"seed=7 n=100 k=2\"");
  app.option("--fd", fd, "the descriptor that the frame goes to");
  const Argument as_text =
      app.option("--print", rows, "print the first so many rows (0: all) and send nothing");
  app.flag("--list", list, "name all probes");
  app.option("--names-fit", shape,
             "whether the probe has names for ROWS COLUMNS: the exit code says")
      .words(2, 2);
  if (const auto code = app.parse(argc, argv)) return *code;
  if (list) {
    for (const auto& [probe, entry] : probes())
      fmt::print("{}\n", probe);
    return 0;
  }
  const auto found = probes().find(name);
  if (found == probes().end()) throw Error("no probe \"{}\"", name);
  if (!shape.empty()) return names_fit(found->second.names, shape[0], shape[1]) ? 0 : 1;
  report_full_stack();
  const Frame frame = run(found->second.run, params_from_text(text));
  if (as_text.given()) return print(frame, found->second, rows);
  std::fflush(nullptr);
  send(fd, encode(frame));
  // Skips exit handlers that the student's code may have left: the answer is given.
  ::_exit(0);
}

}  // namespace
}  // namespace carlo::grader

int main(int argc, char** argv) {
  return carlo::run_main([&] { return carlo::grader::main(argc, argv); });
}
