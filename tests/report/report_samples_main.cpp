// usage: report_samples DIR
// Writes the sample results with their index, and the other pages, for the browser test.

#include <filesystem>
#include <iostream>

#include "report/files/report.h"
#include "tests/report/page_samples.h"
#include "tests/report/report_samples.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: report_samples DIR\n";
    return 2;
  }
  using ursula::SuiteEntry, ursula::ValidationResult, ursula::Verdict;
  namespace test = ursula::test;

  const std::filesystem::path dir = argv[1];
  std::vector<SuiteEntry> entries;
  const auto add = [&](const ValidationResult& result, const char* folder, double seconds) {
    const ursula::RunTime time{seconds, "2026-11-22T05:13:18"};
    writeResults(result, dir / folder, time, ursula::Place::in_suite);
    entries.push_back(suiteEntry(result, folder, time));
  };
  add(test::passedSample(), "passed", 4.2);
  add(test::failedSample(), "failed", 3.9);
  add(test::inconclusiveSample(), "not judgeable", 4.4);
  add(test::externalSample(), "external", 2.1);
  add(test::hostileSample(), "hostile", 0.1);
  entries.push_back(
      {"unreadable", Verdict::fail, "", {}, "scenario.toml:3:1: error: expected a value", {}, "", {}, {}});
  writeResults(test::passedSample(), dir / "alone");
  writeResults(test::longSample(), dir / "long");
  for (const char* machine : {"flight-simulator", "hexa", "hexaglide"})
    writeResults(test::machineSample(machine), dir / machine);
  test::writeSuiteIndex(entries, dir);
  test::writePageSamples(dir);
}
