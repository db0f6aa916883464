#include "apps/watch.h"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>
#include <thread>
#include <tuple>

#include "apps/output.h"
#include "apps/verbs.h"
#include "model/scenario_excerpt.h"

namespace ursula {
namespace {

volatile std::sig_atomic_t interrupted = 0;

/// Notes SIGINT instead of ending the program, while there is nothing to lose.
class NotedInterrupt {
 public:
  NotedInterrupt() {
    struct sigaction noting = {};
    noting.sa_handler = [](int) { interrupted = 1; };
    sigaction(SIGINT, &noting, &before_);
  }
  ~NotedInterrupt() { sigaction(SIGINT, &before_, nullptr); }
  NotedInterrupt(const NotedInterrupt&) = delete;
  NotedInterrupt& operator=(const NotedInterrupt&) = delete;

 private:
  struct sigaction before_ = {};
};

/// Name, time and size of each file; a file that is missing has neither.
using State = std::vector<std::tuple<std::string, std::filesystem::file_time_type, std::uintmax_t>>;

State stateOf(const std::vector<std::filesystem::path>& files) {
  State out;
  for (const std::filesystem::path& file : files) {
    std::error_code missing;
    const auto time = std::filesystem::last_write_time(file, missing);
    const auto size = std::filesystem::file_size(file, missing);
    out.emplace_back(file.string(), time, size);
  }
  return out;
}

int judgedAloud(const std::function<int()>& judge) {
  try {
    return judge();
  } catch (const ScenarioError& error) {
    say("{}\n", atLength(error));
  } catch (const std::exception& error) {
    say("error: {}\n", error.what());
  }
  return exit_bad_input;
}

}  // namespace

int watched(const std::function<int()>& judge, const std::function<std::vector<std::filesystem::path>()>& files) {
  constexpr std::chrono::milliseconds between{200};
  for (;;) {
    // Files that change while they are judged are judged again.
    const std::vector<std::filesystem::path> before = files();
    const State read = stateOf(before);
    const int code = judgedAloud(judge);
    std::fflush(stdout);
    const NotedInterrupt noted;
    say("watching {} file{}; Ctrl-C ends it\n", before.size(), before.size() == 1 ? "" : "s");
    while (stateOf(before) == read) {
      if (interrupted != 0) return code;
      std::this_thread::sleep_for(between);
    }
    std::this_thread::sleep_for(between);  // whoever writes several files or a long one has then finished
  }
}

}  // namespace ursula
