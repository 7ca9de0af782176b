// A fake compiler: its n-th call follows the n-th line of the file "plan" beside it, "good" or the
// message with which it fails; calls after the last line succeed. Its output is a copy of itself,
// which nm can read.

#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  const fs::path self = fs::read_symlink("/proc/self/exe"), folder = self.parent_path();
  const auto call = fs::exists(folder / "calls") ? fs::file_size(folder / "calls") : 0;
  std::ofstream(folder / "calls", std::ios::app) << '.';
  std::ifstream plan(folder / "plan");
  std::string words = "good";
  for (std::size_t i = 0; i <= call && std::getline(plan, words); ++i) {
  }
  if (plan && words != "good") {
    std::cerr << words << '\n';
    return 1;
  }
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string(argv[i]) == "-o") fs::copy_file(self, argv[i + 1]);
  }
  return 0;
}
