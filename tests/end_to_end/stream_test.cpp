// `ursula inverse` as a stream: bounded memory, the same bytes for any number of threads, rows as raw doubles.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/csv.h"
#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const std::string helix_file = URSULA_SCENARIOS "/paper-helix.toml";

/// Returns the largest memory of a run, MB.
double memoryOf(const std::string& samples) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl(URSULA_PROGRAM, "ursula", "inverse", helix_file.c_str(), "--samples", samples.c_str(), "--out", "out.csv",
            static_cast<char*>(nullptr));
    ::_exit(127);
  }
  int status = 0;
  rusage used{};
  EXPECT_EQ(::wait4(child, &status, 0, &used), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  return static_cast<double>(used.ru_maxrss) / 1024;
}

TEST(Stream, takesNoMoreMemoryForMoreSamples) {
  const Program ursula;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(ursula.folder());
  const double few = memoryOf("10000"), many = memoryOf("100000");
  std::filesystem::current_path(before);
  EXPECT_LT(many, few + 16) << "as columns of doubles alone they would take 57 MB more";
  EXPECT_GT(std::filesystem::file_size(ursula.folder() / "out.csv"), 100'000'000u) << "all of it was written";
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(many, 64);
#endif
}

TEST(Stream, isTheSameForAnyNumberOfThreads) {
  const Program ursula;
  const std::string call = "inverse --samples 5003 '" + helix_file + "' --jobs ";
  const UrsulaRun one = ursula.passing(call + "1");
  for (const char* jobs : {"2", "7"}) EXPECT_EQ(ursula(call + jobs).out, one.out) << jobs;
  EXPECT_EQ(ursula("inverse --samples 5003 --format csv '" + helix_file + "'").out, one.out);
  EXPECT_NE(ursula("inverse --samples 5002 '" + helix_file + "'").out, one.out);
}

TEST(Stream, binaryHasTheNumbersOfTheCsv) {
  const Program ursula;
  const CsvTable csv = parseCsv(ursula("inverse --samples 1301 '" + helix_file + "'").out, "stdout");
  ursula.passing("inverse --samples 1301 --format binary --out out.bin '" + helix_file + "'");
  EXPECT_EQ(ursula.files(), 1u);
  const std::string bytes = ursula.read("out.bin");
  const std::string line = bytes.substr(0, bytes.find('\n') + 1);
  const nlohmann::json head = nlohmann::json::parse(line);
  EXPECT_EQ(head.at("columns").get<std::vector<std::string>>(), csv.names);
  EXPECT_EQ(head.at("rows"), csv.rows());
  EXPECT_EQ(head.at("dtype"), "<f8");
  EXPECT_EQ(head.at("offset"), line.size());
  EXPECT_EQ(line.size() % 64, 0u);
  ASSERT_EQ(bytes.size(), line.size() + csv.rows() * csv.names.size() * sizeof(double));
  const char* from = bytes.data() + line.size();
  for (std::size_t row = 0; row < csv.rows(); ++row)
    for (const std::vector<double>& column : csv.columns) {
      double value = 0;
      std::memcpy(&value, from, sizeof(value));
      ASSERT_EQ(value, column[row]) << row;
      from += sizeof(value);
    }
}

TEST(Stream, refusesTheFirstPoseThatCannotBeAndWritesNothing) {
  const Program ursula;
  std::string text = Program::shipped("paper-helix.toml");
  const std::string before = "height_phase = 2.2";
  ursula.write("high.toml", text.replace(text.find(before), before.size(), "height_phase = 3.2"));
  const UrsulaRun one = ursula.ending(2, "inverse high.toml --samples 9001 --jobs 1 --out file.csv");
  EXPECT_THAT(one.err, HasSubstr("leg 6 is out of reach at t = 1.83433 s"));
  for (const char* format : {"csv", "binary"}) {
    const UrsulaRun seven =
        ursula.ending(2, std::string("inverse high.toml --samples 9001 --jobs 7 --out file --format ") + format);
    EXPECT_EQ(seven.err, one.err);
  }
  EXPECT_EQ(ursula.files(), 1u) << "the scenario alone";
  const std::string inverse = "inverse '" + helix_file + "' --out file ";
  expectRefused(
      ursula,
      {{inverse + "--format raw", "format"}, {inverse + "--jobs 0", "jobs"}, {inverse + "--jobs many", "jobs"}});
}

}  // namespace
}  // namespace ursula
