// carlo_test_files TABLE... FOLDER: writes the files of tables (file_table.h), or of folders of
// tables, into a folder, and prints the number of mistakes of each file that has any.

#include "file_table.h"

#include <fmt/core.h>

#include <exception>
#include <filesystem>

int main(int argc, char** argv) {
  try {
    for (int i = 1; i + 1 < argc; ++i) {
      const std::filesystem::path tables = argv[i];
      const auto files = std::filesystem::is_directory(tables)
                             ? common_test::read_file_tables(tables)
                             : common_test::read_file_table(tables);
      common_test::write_files(files, argv[argc - 1]);
      for (const common_test::TableFile& file : files) {
        if (!file.mistakes.empty()) fmt::print("{} {}\n", file.mistakes.size(), file.name);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "carlo_test_files: {}\n", error.what());
    return 1;
  }
  return 0;
}
