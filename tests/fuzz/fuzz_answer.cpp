// The answers of a solver's process.

#include <cstdlib>

#include "base/text.h"
#include "tests/fuzz/fuzz.h"
#include "validation/outside/line_process.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string line = ursula::fuzz::textOf(data, size);
  try {
    if (!ursula::solverAnswer(line).allFinite()) std::abort();
    ++ursula::fuzz::accepted;
  } catch (const ursula::SolverProcessError&) {
  }
  for (const char c : ursula::shown(line, ursula::most_shown))
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') std::abort();
  return 0;
}
