#include "course/guide/compiler_messages.h"
#include "fuzz/target.h"
#include "grader/grade/archive.h"
#include "grader/grade/foreign_symbols.h"
#include "grader/grade/record.h"
#include "grader/judge/asked.h"
#include "grader/protocol/frame.h"
#include "grader/protocol/params.h"
#include "image/exr.h"
#include "image/hdr.h"
#include "renderer/production/checksum.h"
#include "renderer/production/merge.h"
#include "renderer/production/part.h"
#include "renderer/production/resume.h"
#include "scene/load_scene.h"
#include "scene/mesh_file.h"
#include "scene/needs.h"
#include "scene/text.h"
#include "support/error.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

namespace carlo::fuzz {

void read_archive(std::string_view bytes) {
  grader::visit_archive(
      bytes, {},
      [](const grader::ArchiveEntry& entry) {
        require(!entry.path.empty() && entry.path[0] != '/', "an entry's path is absolute");
        require(("/" + entry.path + "/").find("/../") == std::string::npos,
                "an entry's path leads out");
        entry.read();
      },
      [](const std::string&) {});
}

/// With and without sums: what `./carlo render` does for --reference and --resume.
void read_exr(std::string_view bytes) {
  const auto path = as_file(bytes, "image.exr");
  const ExrFile file = carlo::read_exr(path);
  require(file.image.pixels.size() == static_cast<std::size_t>(file.image.width) *
                                          static_cast<std::size_t>(file.image.height),
          "an image has as many pixels as its size says");
  const EarlierRender earlier(path);
  if (earlier.target_error()) {
    earlier.adaptive_state();
  } else {
    earlier.film();
  }
  earlier.counts();
}

void read_frame(std::string_view bytes) {
  const auto frame = grader::decode(bytes);
  if (frame) require(grader::encode(*frame) == bytes, "a frame is written as it was read");
}

void read_hdr(std::string_view bytes) {
  const Image image = carlo::read_hdr(as_file(bytes, "image.hdr")).image;
  require(image.pixels.size() ==
              static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
          "an image has as many pixels as its size says");
}

void read_messages(std::string_view bytes) {
  const auto root = as_file("int main() {\n", "main.cpp").parent_path();
  compiler_text(compiler_messages(bytes, root), 5);
  plain_log(bytes, 20);
}

/// Compares with the C library in the "C" locale. That accepts more (hexadecimal digits), but no
/// white space at the end.
void read_numbers(std::string_view bytes) {
  const std::string text(bytes);
  const auto number = parse_number(text);
  parse_integer(text);
  if (!number) return;
  char* end = nullptr;
  const double right = std::strtod(text.c_str(), &end);
  const std::size_t rest =
      text.find_first_not_of(" \t\n\v\f\r", static_cast<std::size_t>(end - text.c_str()));
  require(end != text.c_str() && rest == std::string::npos && right == *number,
          "a number is what strtod says");
  require(std::isfinite(static_cast<float>(*number)), "a number is within the range of float");
}

void check_mesh(const MeshFile& mesh) {
  for (const glm::uvec3 t : mesh.triangles) {
    for (const std::uint32_t corner : {t.x, t.y, t.z})
      require(corner < mesh.positions.size(), "corners are vertices");
  }
}

void read_obj(std::string_view bytes) {
  check_mesh(carlo::read_obj(as_file(bytes, "mesh.obj")));
}

void read_params(std::string_view bytes) {
  const grader::Params params = grader::params_from_text(bytes);
  const std::string text = to_text(params);
  require(to_text(grader::params_from_text(text)) == text, "parameters survive their text");
}

/// Adds correct lengths and checksums to a header, a line end and sums: no mutation would get past
/// them.
void read_part(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  const std::string_view header = bytes.substr(0, end);
  const std::string_view sums = bytes.substr(std::min(end + 1, bytes.size()));
  Checksum checksum;
  checksum.add({reinterpret_cast<const unsigned char*>(header.data()), header.size()});
  std::string file = "carlo part 2\n";
  const auto add = [&file](std::uint64_t number) {
    file.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  add(header.size()), add(checksum.value());
  file.append(header).append(sums);
  add(sums.size()), add(0);
  const PartFile part(as_file(file, "fuzz.part"));
  const BlockGrid& grid = part.header().grid;
  require(part.header().blocks.count() <= grid.blocks(), "a part has no more blocks than a render");
  Merge({part.path()}).missing();
  if (grid.width > 256 || grid.height > 256) return;
  Film film(grid.width, grid.height, grid.block);
  part.add_to(film);
}

void read_ply(std::string_view bytes) {
  check_mesh(carlo::read_ply(as_file(bytes, "mesh.ply")));
}

void read_questions(std::string_view bytes) {
  const std::string text = to_json(grader::questions_from_json(std::string(bytes)));
  require(to_json(grader::questions_from_json(text)) == text, "questions survive their text");
}

void read_record(std::string_view bytes) {
  const std::string text = to_json(grader::record_from_json(std::string(bytes)));
  require(to_json(grader::record_from_json(text)) == text, "a record survives its text");
}

void read_scene(std::string_view bytes) {
  const Scene scene = load_scene(as_file(bytes, "scene.xml"));
  needs(scene);
}

/// Reads nm's output for an object whose names a student chose.
void read_symbols(std::string_view bytes) {
  grader::Symbols symbols;
  grader::add_symbols(symbols, std::string(bytes));
  for (const auto& [symbol, letters] : symbols)
    require(grader::readable(symbol).size() <= 1000, "a symbol is told in short");
  grader::foreign_symbols(symbols, {}, "lab01");
}

}  // namespace carlo::fuzz
