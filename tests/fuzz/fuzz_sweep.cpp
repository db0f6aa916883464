// A sweep's file, and its points.

#include <cstdlib>

#include "model/scenario.h"
#include "parts/sweep/design.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const ursula::SweepFile sweep = ursula::parseSweepFile(ursula::fuzz::textOf(data, size), "fuzz.toml");
    std::vector<ursula::VariedNumber> numbers;
    for (const ursula::Vary& vary : sweep.vary) numbers.push_back({vary.key, vary.by, 1.5});
    const ursula::SweepPoints points(sweep, numbers);
    if (points.count() < 1) std::abort();
    for (const std::int64_t i : {std::int64_t{0}, points.count() - 1})
      if (points.at(i).size() != numbers.size()) std::abort();
    ++ursula::fuzz::accepted;
  } catch (const ursula::ScenarioError&) {
  }
  return 0;
}
