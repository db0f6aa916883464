#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ursula {

/// Does what will be asked for later, on threads of its own, in order. What throws is left to whoever asks: for tasks
/// that fill something Lazily, so that the answers do not depend on who makes them.
class Ahead {
 public:
  using Task = std::function<void()>;

  /// With `first` to do. Without threads nothing is done ahead. `cut_short` makes tasks that have begun end soon.
  explicit Ahead(int threads, const std::vector<Task>& first = {}, Task cut_short = nullptr);
  /// As abandon().
  ~Ahead();
  Ahead(const Ahead&) = delete;
  Ahead& operator=(const Ahead&) = delete;

  void add(const Task& task);
  /// Waits for tasks that have begun, and forgets the others.
  void finish();
  /// Cuts them short: nobody will ask for what they make.
  void abandon();

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
