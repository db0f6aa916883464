#pragma once

#include <csignal>
#include <cstddef>

namespace ursula {

/// Does `work(what)` first when a signal ends this process while this object lives; newer objects work first. It covers
/// signals that somebody sends or a system limit raises. Crash signals and signals with another handler are not
/// covered. A process forked from this one does no such work.
class AtEnding {
 public:
  using Work = void (*)(const void* what);

  /// `work` may call only async-signal-safe functions. At most 64 objects work at a time; further ones do nothing.
  AtEnding(Work work, const void* what);
  ~AtEnding();
  AtEnding(const AtEnding&) = delete;
  AtEnding& operator=(const AtEnding&) = delete;

 private:
  std::size_t slot_;
};

/// Defers such signals in every thread while this object lives. A deferred signal ends the process when the last of
/// these objects goes; no new object begins after it.
class EndingHeld {
 public:
  EndingHeld();
  ~EndingHeld();
  EndingHeld(const EndingHeld&) = delete;
  EndingHeld& operator=(const EndingHeld&) = delete;
};

}  // namespace ursula
