// Two histories side by side.

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "model/csv.h"
#include "tests/fuzz/fuzz.h"
#include "validation/compare/compare.h"

namespace {

ursula::TimeSeries historyOf(const std::string& text) {
  const ursula::CsvTable table = ursula::parseCsv(text, "fuzz.csv", {{}, false, {}});
  ursula::TimeSeries out;
  for (std::size_t k = 0; k < table.names.size(); ++k) out.add(table.names[k], table.columns[k]);
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto [reference, test] = ursula::fuzz::twoOf(ursula::fuzz::textOf(data, size));
  try {
    const ursula::Comparison found = ursula::compare(historyOf(reference), historyOf(test), {});
    for (const ursula::ChannelComparison& channel : found.channels)
      if (channel.verdict == ursula::Verdict::pass && !std::isfinite(channel.max_error)) std::abort();
  } catch (const ursula::CsvError&) {
  } catch (const std::invalid_argument&) {  // instants that do not increase: said by compare()
  }
  return 0;
}
