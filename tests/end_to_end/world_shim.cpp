// A library to preload that changes clock and locale. Each reading of the wall clock is SHIM_CLOCK_STEP seconds further
// off than the previous one. With SHIM_DECIMAL_POINT the process takes the locale of its environment, as a library may
// do; the variable is the decimal point that this locale must have.

#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <clocale>
#include <cstdlib>
#include <cstring>

namespace {

constexpr int no_such_locale = 99;

/// Without such a locale the test would test nothing.
__attribute__((constructor)) void takeLocale() {
  const char* wanted = std::getenv("SHIM_DECIMAL_POINT");
  if (wanted == nullptr) return;
  std::setlocale(LC_ALL, "");
  if (std::strcmp(std::localeconv()->decimal_point, wanted) != 0) ::_exit(no_such_locale);
}

/// s.
long off() {
  static const char* text = std::getenv("SHIM_CLOCK_STEP");
  static const long step = text == nullptr ? 0 : std::atol(text);
  static std::atomic<long> questions{0};
  return ++questions * step;
}

timespec wallClock() {
  timespec now{};
  ::syscall(SYS_clock_gettime, CLOCK_REALTIME, &now);
  now.tv_sec += off();
  return now;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) time_t time(time_t* out) __THROW {
  const time_t now = wallClock().tv_sec;
  if (out != nullptr) *out = now;
  return now;
}

extern "C" __attribute__((visibility("default"))) int gettimeofday(timeval* out, void*) __THROW {
  const timespec now = wallClock();
  out->tv_sec = now.tv_sec;
  out->tv_usec = now.tv_nsec / 1000;
  return 0;
}

extern "C" __attribute__((visibility("default"))) int clock_gettime(clockid_t clock, timespec* out) __THROW {
  if (clock != CLOCK_REALTIME && clock != CLOCK_REALTIME_COARSE)
    return static_cast<int>(::syscall(SYS_clock_gettime, clock, out));
  *out = wallClock();
  return 0;
}
