#pragma once

#include <csignal>
#include <cstddef>

namespace ursula {

/// While this object lives, `work(what)` runs before a signal ends this process. The work of newer objects runs first.
/// This covers signals that somebody sends or a system limit raises, but neither crash signals nor signals with another
/// handler. A process forked from this one does no such work.
class CleanupOnSignal {
 public:
  using Work = void (*)(const void* what);

  /// `work` may call only async-signal-safe functions. At most 64 objects work at a time; further ones do nothing.
  CleanupOnSignal(Work work, const void* what);
  ~CleanupOnSignal();
  CleanupOnSignal(const CleanupOnSignal&) = delete;
  CleanupOnSignal& operator=(const CleanupOnSignal&) = delete;

 private:
  std::size_t slot_;
};

/// Defers such signals in every thread while this object lives. A deferred signal ends the process when the last of
/// these objects is destroyed. Once a signal is deferred, the constructor waits for that end.
class DeferredSignals {
 public:
  DeferredSignals();
  ~DeferredSignals();
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;
};

}  // namespace ursula
