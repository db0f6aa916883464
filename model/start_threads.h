#pragma once

#include <cstddef>
#include <system_error>
#include <thread>
#include <vector>

namespace ursula {

/// Up to `count` threads that do `work`; fewer where the system gives no more.
template <class Work>
std::vector<std::thread> startThreads(std::size_t count, const Work& work) {
  std::vector<std::thread> threads;
  threads.reserve(count);
  try {
    while (threads.size() < count) threads.emplace_back(work);
  } catch (const std::system_error&) {
    // Whoever asked does the rest himself.
  }
  return threads;
}

}  // namespace ursula
