#include "python/lock.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace ursula::python {
namespace {

/// How long the end waits for work that asks for no signals. Longer work ends with the process.
constexpr std::chrono::seconds patience{1};

/// The threads that work without the lock. Never destroyed, because some of them outlive static objects.
struct Working {
  std::mutex guard;
  std::condition_variable changed;
  int threads = 0;
  std::atomic<bool> ending{false};
  std::thread::id ender;  ///< set before `ending`

  void add(int more) {
    const std::lock_guard<std::mutex> lock(guard);
    threads += more;
    changed.notify_all();
  }
};

Working& working() {
  static Working& one = *new Working;
  return one;
}

[[noreturn]] void hold() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Calls `take`, which may wait for Python's lock.
template <class Take>
auto orHold(const Take& take) {
  try {
    return take();
  } catch (abi::__forced_unwind&) {
    hold();
  }
}

/// Ends the work of this thread, which is without the lock.
[[noreturn]] void stop() {
  working().add(-1);
  hold();
}

bool endedByAnother() { return isEnding() && std::this_thread::get_id() != working().ender; }

void waitForWork() {
  Working& all = working();
  all.ender = std::this_thread::get_id();
  all.ending = true;
  const pybind11::gil_scoped_release unlocked;
  std::unique_lock<std::mutex> lock(all.guard);
  if (all.changed.wait_for(lock, patience, [&all] { return all.threads == 0; })) return;
  // Static objects must not be destroyed under the threads that still work.
  ::on_exit(
      [](int status, void*) {
        std::fflush(nullptr);
        std::_Exit(status);
      },
      nullptr);
}

}  // namespace

bool isEnding() { return working().ending; }

Unlocked::Unlocked() {
  working().add(1);
  state_ = PyEval_SaveThread();
  if (endedByAnother()) stop();
}

Unlocked::~Unlocked() {
  if (endedByAnother()) stop();
  orHold([this] { PyEval_RestoreThread(state_); });
  working().add(-1);
}

Locked::Locked() {
  if (endedByAnother()) hold();
  state_ = orHold([] { return PyGILState_Ensure(); });
}

PyObject* called(PyObject* function, PyObject* argument) {
  return orHold([&] { return PyObject_CallFunctionObjArgs(function, argument, nullptr); });
}

void stopWorkAtEnd() {
  namespace py = pybind11;
  py::module_::import("atexit").attr("register")(py::cpp_function(&waitForWork));
}

}  // namespace ursula::python
