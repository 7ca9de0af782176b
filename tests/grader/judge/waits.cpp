#include "grader/judge/waits.h"

#include <algorithm>
#include <utility>

namespace carlo::grader {

double Waits::newly_waited(Thread& thread, const ThreadEntry& entry, double passed) {
  if (entry.times.ran < thread.times.ran) thread = {};  // another thread with the same id
  // The system reports a wait for a processor only when it ends.
  const bool in_line = entry.ready && entry.times == thread.times;
  thread.in_line = in_line ? thread.in_line + passed : 0;
  thread.times = entry.times;
  const double waited = entry.times.waited + thread.in_line;
  const double news = std::max(0., waited - thread.counted);
  thread.counted += news;
  return news;
}

double Waits::look(const Family& family, double passed) {
  std::map<pid_t, Thread> threads;
  double longest = 0;
  for (const ProcessEntry& process : family) {
    for (const ThreadEntry& entry : list_threads(process)) {
      const auto known = threads_.find(entry.id);
      Thread thread = known == threads_.end() ? Thread{} : known->second;
      longest = std::max(longest, newly_waited(thread, entry, passed));
      longest_run_ = std::max(longest_run_, entry.times.ran);
      threads.insert({entry.id, thread});
    }
  }
  threads_ = std::move(threads);
  return longest;
}

}  // namespace carlo::grader
