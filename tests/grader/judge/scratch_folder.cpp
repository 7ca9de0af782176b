#include "grader/judge/scratch_folder.h"

#include "cli/error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace carlo::grader {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::string name = fs::temp_directory_path() / "carlo-scratch-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw Error("{}: {}", name, std::strerror(errno));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ec;
  fs::remove_all(path_, ec);
}

}  // namespace carlo::grader
