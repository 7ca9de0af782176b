#include "peer_program.h"

#include "course/watch/child.h"
#include "image/exr.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <nlohmann/json.hpp>
#include <poll.h>

#include <optional>
#include <sstream>
#include <string_view>

namespace bench {
namespace {

namespace fs = std::filesystem;

/// The output of a program until it ends.
struct Said {
  int exit_code;
  std::string text;
};

Said run(const std::vector<std::string>& command, const std::function<void()>& wait) {
  carlo::Child child(command);
  while (!child.ended()) {
    wait();
    pollfd readable{child.fd(), POLLIN, 0};
    (void)::poll(&readable, 1, 200);
  }
  return {child.exit_code(), child.output()};
}

/// The answer of the peer's script in its output, and the last line that reports an error.
struct Lines {
  std::optional<nlohmann::json> answer;
  std::string error = "no error message";
};

Lines read(const std::string& text) {
  constexpr std::string_view mark = "carlo: ";
  Lines result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(mark, 0) == 0) {
      result.answer = nlohmann::json::parse(line.substr(mark.size()), nullptr, false);
    } else if (line.find("Error") != std::string::npos) {
      result.error = line;
    }
  }
  return result;
}

}  // namespace

bool starts(const std::vector<std::string>& command) {
  try {
    return run(command, [] {}).exit_code == 0;
  } catch (const carlo::Error&) {
    return false;
  }
}

nlohmann::json answer_of(const PeerProgram& peer, const nlohmann::json& task,
                         const std::function<void()>& wait) {
  fs::create_directories(peer.scratch);
  const fs::path input = peer.scratch / "peer.json";
  carlo::write_file(input, task.dump() + "\n");
  std::vector<std::string> command = peer.command;
  command.push_back(input.string());
  const Said said = run(command, wait);
  const Lines lines = read(said.text);
  if (said.exit_code != 0 || !lines.answer || !lines.answer->is_object()) {
    throw carlo::Error("{} failed (exit code {}): {}", peer.name, said.exit_code, lines.error);
  }
  return *lines.answer;
}

PeerImage render_by(const PeerProgram& peer, nlohmann::json scene,
                    const std::function<void()>& wait) {
  const fs::path output = fs::absolute(peer.scratch / "peer.exr");
  fs::remove(output);  // an earlier run's image must not count as a result
  scene["output"] = output.string();
  const nlohmann::json answer = answer_of(peer, scene, wait);
  return {carlo::read_exr(output).image, answer.value("seconds", 0.0),
          answer.value("version", "?")};
}

}  // namespace bench
