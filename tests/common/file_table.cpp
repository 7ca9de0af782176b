#include "file_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string_view>

namespace common_test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view scene_head =
    "<scene version=\"0.6.0\">\n"
    "  <sensor type=\"perspective\"><float name=\"fov\" value=\"45\"/></sensor>\n";

int hexadecimal_digit(char c) {
  const std::size_t value = std::string_view("0123456789abcdef").find(c);
  if (value == std::string_view::npos) throw std::runtime_error("\\x needs two digits, 0-9a-f");
  return static_cast<int>(value);
}

/// Returns the bytes of a line, with its newline unless a backslash removes it.
std::string unescaped(const std::string& line) {
  std::string out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\') {
      out += line[i];
      continue;
    }
    if (++i == line.size()) return out;
    if (line[i] == 'x' && i + 2 < line.size()) {
      out +=
          static_cast<char>(16 * hexadecimal_digit(line[i + 1]) + hexadecimal_digit(line[i + 2]));
      i += 2;
    } else if (line[i] == '0' || line[i] == '\\') {
      out += line[i] == '0' ? '\0' : '\\';
    } else {
      throw std::runtime_error(fmt::format("\\{} is no escape", line[i]));
    }
  }
  return out + '\n';
}

/// Takes a table's lines one after the other.
class Reader {
 public:
  void take(const std::string& line) {
    if (line.starts_with("== ")) {
      end_file();
      begin_file(line.substr(3));
    } else if (files_.empty()) {
      return;
    } else if (line.starts_with("^^ ")) {
      take_placed(line.substr(3));
    } else if (const std::size_t caret = line.find("^ ");
               caret != std::string::npos && line.find_first_not_of(' ') == caret) {
      take_caret(caret + 1, line.substr(caret + 2));
    } else {
      take_text(line);
    }
  }
  std::vector<TableFile> result() {
    end_file();
    return std::move(files_);
  }

 private:
  void begin_file(const std::string& title) {
    const std::size_t bar = title.find(" | ");
    TableFile file{.name = title.substr(0, bar), .expected = {}, .bytes = {}, .mistakes = {}};
    if (bar != std::string::npos) file.expected = title.substr(bar + 3);
    if (!names_.insert(file.name).second) throw std::runtime_error(file.name + " is there twice");
    files_.push_back(file);
    blank_ = framed_ = false;
  }

  void take_text(const std::string& line) {
    std::string& bytes = files_.back().bytes;
    if (bytes.empty() && line.starts_with(' ') && files_.back().name.ends_with(".xml")) {
      bytes = scene_head;
      framed_ = true;
    }
    if (blank_) bytes += '\n';
    blank_ = line.empty();
    if (!blank_) bytes += unescaped(line);
  }

  void take_caret(std::size_t column, const std::string& phrase) {
    TableFile& file = files_.back();
    const auto ends = std::count(file.bytes.begin(), file.bytes.end(), '\n');
    const bool open = file.bytes.empty() || !file.bytes.ends_with('\n');
    file.mistakes.push_back(
        {fmt::format("{}:{}:{}", file.name, ends + (open ? 1 : 0), column), phrase});
  }

  void take_placed(const std::string& text) {
    const std::size_t colon = text.find(": ");
    if (colon == std::string::npos) throw std::runtime_error("expected ^^ PLACE: PHRASE");
    files_.back().mistakes.push_back({text.substr(0, colon), text.substr(colon + 2)});
  }

  void end_file() {
    if (framed_) files_.back().bytes += "</scene>\n";
    framed_ = false;
  }

  std::vector<TableFile> files_;
  std::set<std::string> names_;
  bool blank_ = false;   ///< The last line was blank: part of the file if another follows.
  bool framed_ = false;  ///< The file is a scene to which a camera is added.
};

}  // namespace

std::vector<TableFile> read_file_table(const fs::path& table) {
  std::ifstream in(table);
  if (!in) throw std::runtime_error("cannot read " + table.string());
  Reader reader;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    try {
      reader.take(line);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", table.string(), number, error.what()));
    }
  }
  return reader.result();
}

std::vector<TableFile> read_file_tables(const fs::path& folder) {
  std::vector<TableFile> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".txt") continue;
    const std::vector<TableFile> more = read_file_table(entry.path());
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

void write_files(const std::vector<TableFile>& files, const fs::path& folder) {
  for (const TableFile& file : files) {
    const fs::path path = folder / file.name;
    fs::create_directories(path.parent_path());
    std::ofstream out(path, std::ios::binary);
    out << file.bytes;
    if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
  }
}

}  // namespace common_test
