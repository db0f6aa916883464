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

  BackgroundTasks() = default;
  ~BackgroundTasks() { finish(); }
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;

  /// Starts with the tasks `first`. Without threads nothing is done.
  void start(int threads, const std::vector<Task>& first);
  void add(const Task& task);
  /// Waits for running tasks and drops the others.
  void finish();

 private:
  void work();

  std::mutex guard_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  bool finished_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace ursula
