#pragma once

#include <filesystem>
#include <string>
#include <vector>

// A table holds many small files for tests, each with what is expected of it. Text before the
// first title is a comment. A title is
//
//   == NAME
//   == NAME | what the test expects of the file, in its own words
//
// and the lines up to the next title are the file, except for a blank one before that title. In
// these lines
//
//   \xNN, \0, \\    are a byte, a zero byte and a backslash,
//   \               at the end of a line joins it to the next one,
//   ^ PHRASE        says that the file is rejected where the caret points in the line above, with
//                   a message that contains the phrase,
//   ^^ PLACE: PHRASE    says that it is rejected at this place, FILE:LINE:COLUMN.
//
// A scene, NAME.xml, whose first line is indented is put into <scene> behind a camera: that line
// becomes the scene's third.

namespace common_test {

/// An error that the reader of a file must report.
struct Mistake {
  std::string place;   ///< FILE:LINE:COLUMN
  std::string phrase;  ///< part of the message
};

struct TableFile {
  std::string name;      ///< including its folders
  std::string expected;  ///< from its title
  std::string bytes;
  std::vector<Mistake> mistakes;  ///< in the order in which they are reported
};

/// Throws std::runtime_error naming the line that cannot be understood.
std::vector<TableFile> read_file_table(const std::filesystem::path& table);

/// Reads the files of all tables (*.txt) in a folder.
std::vector<TableFile> read_file_tables(const std::filesystem::path& folder);

void write_files(const std::vector<TableFile>& files, const std::filesystem::path& folder);

}  // namespace common_test
