#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Small files that tests read, many in a text, each beside what is expected of it. What stands
// before the first title is a comment. A title is
//
//   == NAME
//   == NAME | what the test expects of the file, in its own words
//
// and the lines up to the next title are the file's, except for a blank one before that title. In
// them
//
//   \xNN, \0, \\    are a byte, a zero byte and a backslash,
//   \               at the end of a line joins it to the next one,
//   ^ PHRASE        says that the file is refused where the caret points to in the line above, by a
//                   message with that phrase,
//   ^^ PLACE: PHRASE    that it is refused at this place, FILE:LINE:COLUMN.
//
// A scene, NAME.xml, whose first line is indented stands in <scene> behind a camera: that line is
// the scene's third.

namespace common_test {

/// What the reader of a file must say of it.
struct Mistake {
  std::string place;   ///< FILE:LINE:COLUMN
  std::string phrase;  ///< of the message
};

struct TableFile {
  std::string name;      ///< with the folders that it lies in
  std::string expected;  ///< as its title says
  std::string bytes;
  std::vector<Mistake> mistakes;  ///< in the order in which they are told
};

/// Throws std::runtime_error naming the line that cannot be understood.
std::vector<TableFile> read_file_table(const std::filesystem::path& table);

/// The files of all tables (*.txt) in a folder.
std::vector<TableFile> read_file_tables(const std::filesystem::path& folder);

void write_files(const std::vector<TableFile>& files, const std::filesystem::path& folder);

}  // namespace common_test
