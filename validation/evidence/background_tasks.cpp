#include "validation/evidence/background_tasks.h"

#include <algorithm>
#include <utility>

#include "base/start_threads.h"

namespace ursula {

void BackgroundTasks::start(int threads, const std::vector<Task>& first) {
  tasks_.assign(first.begin(), first.end());
  threads_ = startThreads(std::max(threads, 0), [this] { work(); });
}

void BackgroundTasks::add(const Task& task) {
  if (threads_.empty()) return;
  {
    const std::lock_guard<std::mutex> lock(guard_);
    tasks_.push_back(task);
  }
  changed_.notify_one();
}

void BackgroundTasks::finish() {
  {
    const std::lock_guard<std::mutex> lock(guard_);
    finished_ = true;
    tasks_.clear();
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void BackgroundTasks::work() {
  while (true) {
    Task task;
    {
      std::unique_lock<std::mutex> lock(guard_);
      changed_.wait(lock, [this] { return finished_ || !tasks_.empty(); });
      if (finished_) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    try {
      task();
    } catch (...) {
      // A later request reports the error.
    }
  }
}

}  // namespace ursula
