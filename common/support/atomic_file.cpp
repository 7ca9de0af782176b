#include "support/atomic_file.h"

#include "support/error.h"

#include <unistd.h>

#include <array>
#include <fstream>
#include <random>
#include <system_error>

namespace carlo {

namespace fs = std::filesystem;

/// Processes on several machines, which may share a process id, write into shared folders.
static std::string unlike_others() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  // A link stays a link: its target is replaced.
  std::error_code link;
  if (fs::is_symlink(target_, link)) target_ = fs::weakly_canonical(target_);
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  std::error_code ec;
  if (!fs::is_directory(folder, ec)) {
    throw Error("cannot write {}: {} is not a folder", target_.string(), folder.string());
  }
  if (fs::is_directory(target_, ec))
    throw Error("cannot write {}: it is a folder", target_.string());
  if (::access(folder.c_str(), W_OK) != 0) {
    throw Error("cannot write {}: no permission in {}", target_.string(), folder.string());
  }
  temporary_ = folder / fmt::format(".{}.{}{}", target_.stem().string(), unlike_others(),
                                    target_.extension().string());
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ec;
  fs::remove(temporary_, ec);
}

void AtomicFile::commit() {
  std::error_code ec;
  fs::rename(temporary_, target_, ec);
  if (ec) throw Error("cannot write {}: {}", target_.string(), ec.message());
  committed_ = true;
}

void write_file(const fs::path& target, std::string_view text) {
  AtomicFile file(target);
  std::ofstream out(file.path(), std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw Error("cannot write {}: is the disk full?", target.string());
  file.commit();
}

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("cannot read {}", path.string());
  // In pieces, because a pipe has no size.
  std::string text;
  std::array<char, 1 << 16> piece;
  do {
    in.read(piece.data(), piece.size());
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  } while (in);
  if (in.bad()) throw Error("cannot read {}", path.string());
  return text;
}

}  // namespace carlo
