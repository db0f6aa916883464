// A CSV, read as numbers, as a sampled motion, and as torques.

#include <cstdlib>

#include "base/csv.h"
#include "base/errors.h"
#include "model/trajectories/trajectories.h"
#include "tests/fuzz/fuzz.h"
#include "validation/subject/torque_file.h"

namespace {

template <class Read>
void tryTo(Read&& read) {
  try {
    read();
    ++ursula::fuzz::accepted;
  } catch (const ursula::CsvError&) {
  } catch (const ursula::InvalidParameter&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = ursula::fuzz::textOf(data, size);
  tryTo([&] {
    const ursula::CsvTable table = ursula::parseCsv(text, "fuzz.csv", {{}, false, {}});
    for (const auto& column : table.columns)
      if (column.size() != table.rows()) std::abort();
  });
  tryTo([&] { ursula::makeSamples(ursula::parseCsv(text, "fuzz.csv"))->at(0.1); });
  tryTo([&] { ursula::within(ursula::parseTorqueFile(text, "fuzz.csv"), 3); });
  return 0;
}
