#include "base/signal_cleanup.h"

#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>

namespace ursula {
namespace {

constexpr std::array<int, 10> ends_process = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,   SIGALRM,
                                              SIGUSR1, SIGUSR2, SIGXCPU, SIGVTALRM, SIGPROF};

/// A slot is in use when its `work` is not null.
struct Slot {
  std::atomic<CleanupOnSignal::Work> work{nullptr};
  const void* what = nullptr;
  pid_t process = 0;
};
std::array<Slot, 64> slots;

std::atomic<int> holders{0};  ///< number of threads that hold
std::atomic<int> came{0};     ///< the first signal that shall end the process, or 0
thread_local int depth = 0;   ///< number of nested holds in this thread

void nothing(const void*) {}

/// Two threads may run this at once.
void workAndEnd() {
  for (auto slot = slots.rbegin(); slot != slots.rend(); ++slot)
    if (const CleanupOnSignal::Work work = slot->work; work != nullptr && slot->process == ::getpid()) work(slot->what);
  const int signal = came;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void endUnlessHeld(int signal) {
  int none = 0;
  came.compare_exchange_strong(none, signal);
  if (holders == 0) workAndEnd();
}

void letGo() {
  if (--holders == 0 && came != 0) workAndEnd();
}

void catchSignals() {
  for (const int signal : ends_process) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_DFL) std::signal(signal, endUnlessHeld);  // NOLINT(performance-no-int-to-ptr)
  }
}

/// Only the forking thread exists in the child, so the holds of the others do not count there.
[[maybe_unused]] const int in_child = pthread_atfork(nullptr, nullptr, [] { holders = depth > 0 ? 1 : 0; });

}  // namespace

CleanupOnSignal::CleanupOnSignal(Work work, const void* what) : slot_(0) {
  const DeferredSignals held;
  for (Work free = nullptr; slot_ < slots.size(); ++slot_, free = nullptr)
    if (slots[slot_].work.compare_exchange_strong(free, nothing)) break;
  if (slot_ == slots.size()) return;
  slots[slot_].what = what;
  slots[slot_].process = ::getpid();
  slots[slot_].work = work;
}

CleanupOnSignal::~CleanupOnSignal() {
  const DeferredSignals held;  // the work may be running in another thread's handler
  if (slot_ < slots.size()) slots[slot_].work = nullptr;
}

DeferredSignals::DeferredSignals() {
  if (depth++ > 0) return;
  catchSignals();
  ++holders;
  if (came == 0) return;
  letGo();
  for (;;) ::pause();  // another thread ends the process
}

DeferredSignals::~DeferredSignals() {
  if (--depth == 0) letGo();
}

}  // namespace ursula
