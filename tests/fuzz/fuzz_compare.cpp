// The comparison of two histories.

#include <cmath>
#include <cstdlib>

#include "base/csv.h"
#include "parts/compare/compare.h"
#include "tests/fuzz/fuzz.h"

namespace {

ursula::TimeSeries readOf(const std::string& text) {
  return ursula::historyOf(ursula::parseCsv(text, "fuzz.csv", {{}, false, {}}));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto [reference, test] = ursula::fuzz::twoOf(ursula::fuzz::textOf(data, size));
  try {
    const ursula::Comparison found = ursula::compare(readOf(reference), readOf(test), {});
    for (const ursula::ChannelComparison& channel : found.channels)
      if (channel.verdict == ursula::Verdict::pass && !std::isfinite(channel.max_error)) std::abort();
    ++ursula::fuzz::accepted;
  } catch (const ursula::CsvError&) {
  }
  return 0;
}
