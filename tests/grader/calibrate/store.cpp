#include "grader/calibrate/store.h"

#include "support/atomic_file.h"
#include "support/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

void append_to(const fs::path& file, const std::string& bytes) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (fd < 0) throw Error("cannot write {}: {}", file.string(), std::strerror(errno));
  const ssize_t written = ::write(fd, bytes.data(), bytes.size());
  const bool closed = ::close(fd) == 0;
  if (written != static_cast<ssize_t>(bytes.size()) || !closed) {
    throw Error("cannot write {}: is the disk full?", file.string());
  }
}

bool ends_within_a_line(const fs::path& file) {
  if (!fs::exists(file)) return false;
  const std::string text = read_file(file);
  return !text.empty() && text.back() != '\n';
}

}  // namespace

Store::Store(fs::path folder) : folder_(std::move(folder)) {
  std::error_code ec;
  fs::create_directories(folder_, ec);
  if (!fs::is_directory(folder_)) throw Error("cannot make the folder {}", folder_.string());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() == ".jsonl") read(entry.path());
  }
}

fs::path Store::file_of(int lab) const {
  return folder_ / fmt::format("lab{:02}.jsonl", lab);
}

void Store::read(const fs::path& file) {
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    const std::optional<Record> record = record_from(line);
    unreadable_ += record ? 0 : 1;
    if (record) records_[record->key] = *record;
  }
}

void Store::append(const Record& record) {
  const fs::path file = file_of(record.key.lab);
  const bool torn = begun_.insert(file).second && ends_within_a_line(file);
  std::string line = to_line(record);
  line.insert(line.begin(), torn ? 1 : 0, '\n');
  line.push_back('\n');
  append_to(file, line);
  records_[record.key] = record;
}

}  // namespace carlo::grader
