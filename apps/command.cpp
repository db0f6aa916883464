#include "apps/command.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "base/child_process.h"

namespace ursula {
namespace {

/// Returns everything until all writers have closed the other end.
std::string allOf(int from) {
  std::string out;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t got = ::read(from, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return out;
    out.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

std::string outputOf(const std::vector<std::string>& words) try {
  ChildProcess process({words, {}, false});
  std::string out = allOf(process.from());
  process.wait();
  if (process.status() == 0) return out;
  throw std::runtime_error(words.front() + " " + process.howItEnded());
} catch (const std::system_error& refusal) {
  if (refusal.code() == std::errc::no_such_file_or_directory)
    throw std::runtime_error("there is no " + words.front() + " on PATH");
  throw;
}

}  // namespace ursula
