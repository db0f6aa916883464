#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ursula {

/// Does tasks in order on threads of its own. Each task fills something Lazily, so that answers do not depend on who
/// makes them. What a task throws is dropped: whoever asks for its answer meets the error again.
class BackgroundTasks {
 public:
  using Task = std::function<void()>;

  /// With `first` to do; without threads nothing is done. `cut_short` makes tasks that have begun end soon.
  explicit BackgroundTasks(int threads, const std::vector<Task>& first = {}, Task cut_short = nullptr);
  /// Cuts short what has begun, as nobody will ask for it, and waits for that.
  ~BackgroundTasks();
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;

  void add(const Task& task);
  /// Waits for tasks that have begun, and forgets the others.
  void finish();

 private:
  void work();

  Task cut_short_;
  std::mutex guard_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  bool finished_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace ursula
