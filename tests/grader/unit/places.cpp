#include "places.h"

std::filesystem::path fixture_worker() {
  return FIXTURE_WORKER;
}

std::filesystem::path fixture_folder() {
  return FIXTURE_FOLDER;
}
