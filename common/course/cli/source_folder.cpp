#include "course/cli/source_folder.h"

namespace carlo {

std::filesystem::path source_folder() {
  return CARLO_SOURCE_FOLDER;
}

}  // namespace carlo
