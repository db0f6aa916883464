#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/studies/identify/random_logs.h"

namespace ursula {
namespace {

/// URSULA_LOGS sets the number of logs. docs/identify.md names the number behind its evidence; a run of all tests makes
/// a few.
int logsAsked() {
  const char* asked = std::getenv("URSULA_LOGS");
  return asked == nullptr ? 12 : std::atoi(asked);
}

/// URSULA_LOGS_BEFORE skips so many logs, so that a long run may be done in parts.
unsigned seedOf(int i) {
  const char* before = std::getenv("URSULA_LOGS_BEFORE");
  return 1 + static_cast<unsigned>(i + (before == nullptr ? 0 : std::atoi(before)));
}

IdentifyResult identified(const RandomLog& log) {
  IdentifyOptions options;
  options.tolerances = log.tolerances;
  IdentifyResult out = identify(log.model, logOf(log.rows, log.model), options);
  if (std::getenv("URSULA_LOGS_SHOW") != nullptr)
    std::printf("%u %s wrong %s\n%s\n", log.how.seed, log.model.name.c_str(), log.wrong.c_str(),
                identifyText(out).c_str());
  return out;
}

TEST(RandomLogs, intervalsHoldTheTruthAndRightModelsPass) {
  LogStatistics found;
  for (int i = 0; i < logsAsked(); ++i) {
    const RandomLog log = randomLog(seedOf(i));
    found.add(log, identified(log));
  }
  std::printf("%s", found.text().c_str());
  for (const char* group : {"mass", "center", "inertia", "friction"}) {
    ASSERT_GT(found.within.at(group).of, logsAsked() / 2) << group;
    EXPECT_GT(found.within.at(group).share(), 0.93) << group;
  }
  EXPECT_GT(found.delay_near.share(), 0.9);
  EXPECT_GE(found.right_passed.share(), 0.9);
}

/// The log of one motion shows few numbers to within half of their tolerance, beside the tolerances of all others. The
/// statistics of those that it shows are separate.
TEST(RandomLogs, numberThatIsOffByFiveTolerancesIsNamed) {
  LogStatistics any, shown;
  for (int i = 0; i < logsAsked(); ++i) {
    const unsigned seed = 1000 + seedOf(i);
    const std::vector<std::string> candidates = massesAndCenters(randomLog(seed));
    const RandomLog log = randomLog(seed, candidates);
    const IdentifyResult result = identified(log);
    any.add(log, result);
    std::vector<std::string> found;
    for (const MeasuredNumber& each : result.numbers)
      if (each.least_found > 0 && each.least_found <= 5 * each.tolerance &&
          std::count(candidates.begin(), candidates.end(), each.name) > 0)
        found.push_back(each.name);
    if (found.empty()) continue;
    const RandomLog another = randomLog(seed, found);
    shown.add(another, identified(another));
  }
  std::printf("any number\n%snumber that the log shows\n%s", any.text().c_str(), shown.text().c_str());
  ASSERT_GT(shown.wrong_named.of, 0);
  EXPECT_GE(shown.wrong_failed.share(), 0.9);
  EXPECT_GE(shown.wrong_named.share(), 0.9);
}

}  // namespace
}  // namespace ursula
