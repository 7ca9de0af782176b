#include "cli/atomic_file.h"
#include "cli/error.h"
#include "scene/mesh_file.h"
#include "scene/text.h"

#include <algorithm>
#include <array>

namespace carlo {
namespace {

// Why a reader of our own: tinyobjloader takes a coordinate it cannot parse for 0 and goes on.
class ObjReader {
 public:
  explicit ObjReader(std::string name) : name_(std::move(name)) {}

  MeshFile read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      const std::string_view line = text.substr(0, end);
      read_line(line.substr(0, line.find('#')));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (materials_) mesh_.notes.push_back(name_ + ": materials named in the file are not used");
    if (strays_ > 0) {
      mesh_.notes.push_back(fmt::format("{}: {} lines and points left out", name_, strays_));
    }
    return std::move(mesh_);
  }

 private:
  void read_line(std::string_view line) {
    auto parts = words(line);
    if (parts.empty()) return;
    const std::string_view keyword = parts.front();
    parts.erase(parts.begin());
    if (keyword == "v") return read_vertex(parts);
    if (keyword == "f") return read_face(parts);
    if (keyword == "l" || keyword == "p") {
      ++strays_;
    } else if (keyword == "usemtl") {
      materials_ = true;
    } else if (std::find(passed_over.begin(), passed_over.end(), keyword) == passed_over.end()) {
      wrong(fmt::format("{} is not understood", in_quotes(keyword)));
    }
  }

  // x y z, perhaps followed by w = 1 or by a colour.
  void read_vertex(const std::vector<std::string_view>& parts) {
    if (parts.size() != 3 && parts.size() != 4 && parts.size() != 6) {
      wrong(fmt::format("a vertex has 3 numbers, got {}", parts.size()));
    }
    std::array<double, 6> numbers{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto number = parse_number(parts[i]);
      if (!number) wrong(fmt::format("expected a finite number, got {}", in_quotes(parts[i])));
      numbers.at(i) = *number;
    }
    if (parts.size() == 4 && numbers[3] != 1) wrong("a vertex with w other than 1");
    mesh_.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
  }

  void read_face(const std::vector<std::string_view>& parts) {
    if (parts.size() < 3) wrong(fmt::format("a face has 3 corners or more, got {}", parts.size()));
    std::vector<std::uint32_t> corners;
    corners.reserve(parts.size());
    for (const std::string_view part : parts)
      corners.push_back(corner(part));
    add_polygon(mesh_, corners);
  }

  // "v", "v/vt", "v//vn" or "v/vt/vn"; negative numbers count back from the newest vertex.
  std::uint32_t corner(std::string_view part) {
    const std::size_t slash = std::min(part.find('/'), part.size());
    const auto index = parse_integer(part.substr(0, slash));
    if (!index) wrong(fmt::format("expected a vertex number, got {}", in_quotes(part)));
    const auto count = static_cast<std::ptrdiff_t>(mesh_.positions.size());
    const std::ptrdiff_t position = *index > 0 ? *index - 1 : count + *index;
    if (*index == 0 || position < 0 || position >= count) {
      wrong(fmt::format("vertex {} is out of range: {} stand above", *index, count));
    }
    const std::size_t last = part.rfind('/');
    if (last != slash && last != std::string_view::npos) mesh_.vertex_normals = true;
    return static_cast<std::uint32_t>(position);
  }

  [[noreturn]] void wrong(const std::string& message) const {
    throw Error("{}:{}: {}", name_, line_, message);
  }

  static constexpr std::array<std::string_view, 6> passed_over = {"vt", "vn", "o",
                                                                  "g",  "s",  "mtllib"};
  std::string name_;
  int line_ = 0;
  int strays_ = 0;
  bool materials_ = false;
  MeshFile mesh_;
};

}  // namespace

MeshFile read_obj(const std::filesystem::path& path) {
  return ObjReader(path.filename().string()).read(read_file(path));
}

void add_polygon(MeshFile& mesh, const std::vector<std::uint32_t>& corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
  }
}

}  // namespace carlo
