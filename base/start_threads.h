#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace ursula {

/// Starts up to `count` threads that do `work`; fewer if the system gives no more.
template <class Work>
std::vector<std::thread> startThreads(std::size_t count, const Work& work) {
  std::vector<std::thread> threads;
  threads.reserve(count);
  try {
    while (threads.size() < count) threads.emplace_back(work);
  } catch (const std::system_error&) {
    // The caller does the rest itself.
  } catch (const std::bad_alloc&) {
    // Likewise; threads that already run must still be joined.
  }
  return threads;
}

/// Does `task(k)` for k = 0 … count − 1 on `jobs` threads. Nothing begins after the first exception, which is rethrown.
/// oneTBB does not fit, because tasks take seconds, wait for each other, and must go on with fewer threads.
template <class Task>
void inParallel(int jobs, int count, const Task& task) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto work = [&] {
    for (int k = next++; k < count; k = next++) try {
        task(k);
      } catch (...) {
        next = count;
        const std::lock_guard<std::mutex> lock(guard);
        if (!failure) failure = std::current_exception();
      }
  };
  std::vector<std::thread> threads = startThreads(std::max(std::min(jobs, count) - 1, 0), work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ursula
