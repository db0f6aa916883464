#include "base/at_ending.h"

#include <unistd.h>

#include <array>
#include <atomic>

namespace ursula {
namespace {

constexpr std::array<int, 10> ends_process = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,   SIGALRM,
                                              SIGUSR1, SIGUSR2, SIGXCPU, SIGVTALRM, SIGPROF};

/// Whose `work` is not null, is in use.
struct Slot {
  std::atomic<AtEnding::Work> work{nullptr};
  const void* what = nullptr;
  pid_t process = 0;
};
std::array<Slot, 64> slots;

void nothing(const void*) {}

void workAndEnd(int signal) {
  for (auto slot = slots.rbegin(); slot != slots.rend(); ++slot)
    if (const AtEnding::Work work = slot->work; work != nullptr && slot->process == ::getpid()) work(slot->what);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

AtEnding::AtEnding(Work work, const void* what) : slot_(0) {
  const EndingHeld held;
  for (Work free = nullptr; slot_ < slots.size(); ++slot_, free = nullptr)
    if (slots[slot_].work.compare_exchange_strong(free, nothing)) break;
  if (slot_ == slots.size()) return;
  slots[slot_].what = what;
  slots[slot_].process = ::getpid();
  slots[slot_].work = work;
  for (const int signal : ends_process) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_DFL) std::signal(signal, workAndEnd);  // NOLINT(performance-no-int-to-ptr)
  }
}

AtEnding::~AtEnding() {
  if (slot_ < slots.size()) slots[slot_].work = nullptr;
}

EndingHeld::EndingHeld() {
  sigset_t held;
  sigemptyset(&held);
  for (const int signal : ends_process) sigaddset(&held, signal);
  pthread_sigmask(SIG_BLOCK, &held, &before_);
}

EndingHeld::~EndingHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace ursula
