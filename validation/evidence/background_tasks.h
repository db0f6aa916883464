#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ursula {

/// Runs tasks in order on its own threads. Tasks must fill something Lazy, so results do not depend on who computes
/// them. It drops exceptions, because a later request meets them again.
class BackgroundTasks {
 public:
  using Task = std::function<void()>;

  /// Starts with the tasks `first`. Without threads nothing is done. `cut_short` makes running tasks end soon.
  explicit BackgroundTasks(int threads, const std::vector<Task>& first = {}, Task cut_short = nullptr);
  /// Cuts running tasks short, because nobody needs their results, and waits for them.
  ~BackgroundTasks();
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;

  void add(const Task& task);
  /// Waits for running tasks and drops the others.
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
