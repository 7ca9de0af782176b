#pragma once

#include "scene/load_scene.h"
#include "temporary_folder.h"

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace scene_test {

using common_test::TemporaryFolder;

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream out(path, std::ios::binary);
  out << bytes;
  REQUIRE(out.good());
}

/// The scene of a file with this text.
inline carlo::Scene load_text(const std::string& text,
                              const std::map<std::string, std::string>& parameters = {}) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "scene.xml", text);
  return carlo::load_scene(folder.path() / "scene.xml", parameters);
}

/// A scene with these elements and a camera.
inline carlo::Scene load_elements(const std::string& elements) {
  return load_text("<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" " +
                   std::string("value=\"90\"/></sensor>") + elements + "</scene>");
}

/// True if two points agree within `tolerance` in each coordinate; false for NaN.
inline bool close(carlo::Vec3 a, carlo::Vec3 b, float tolerance = 1e-5f) {
  const carlo::Vec3 d = glm::abs(a - b);
  return d.x <= tolerance && d.y <= tolerance && d.z <= tolerance;
}

}  // namespace scene_test
