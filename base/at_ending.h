#pragma once

#include <csignal>
#include <cstddef>

namespace ursula {

/// While this is there, a signal that ends this process has `work(what)` done first, that of the newest before older
/// ones. All that somebody sends or a limit of the system does; not those of a crash, after which nothing can be relied
/// on, nor those that somebody else handles. A process forked from this one has no part in it.
class AtEnding {
 public:
  using Work = void (*)(const void* what);

  /// `work` may call only what a signal's handler may. Of more than 64 at a time the further ones are not done.
  AtEnding(Work work, const void* what);
  ~AtEnding();
  AtEnding(const AtEnding&) = delete;
  AtEnding& operator=(const AtEnding&) = delete;

 private:
  std::size_t slot_;
};

/// Such signals wait while this is there, whatever thread they come to; one that came ends the process when the last of
/// these goes, and none begins after it.
class EndingHeld {
 public:
  EndingHeld();
  ~EndingHeld();
  EndingHeld(const EndingHeld&) = delete;
  EndingHeld& operator=(const EndingHeld&) = delete;
};

}  // namespace ursula
