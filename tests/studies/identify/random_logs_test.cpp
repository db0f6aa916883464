#include <gtest/gtest.h>

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

void addLogs(RandomWrong wrong, unsigned first, LogStatistics& out) {
  for (int i = 0; i < logsAsked(); ++i) {
    const RandomLog log = randomLog(first + static_cast<unsigned>(i), wrong);
    IdentifyOptions options;
    options.tolerances = log.tolerances;
    const IdentifyResult result = identify(log.model, logOf(log.rows, log.model), options);
    out.add(log, result);
    if (std::getenv("URSULA_LOGS_SHOW") != nullptr)
      std::printf("%u %s wrong %s\n%s\n", first + static_cast<unsigned>(i), log.model.name.c_str(), log.wrong.c_str(),
                  identifyText(result).c_str());
  }
}

TEST(RandomLogs, intervalsHoldTheTruthAndRightModelsPass) {
  LogStatistics found;
  addLogs(RandomWrong::nothing, 1, found);
  std::printf("%s", found.text().c_str());
  for (const char* group : {"mass", "center", "inertia", "friction"}) {
    ASSERT_GT(found.within.at(group).of, 20) << group;
    EXPECT_GT(found.within.at(group).share(), 0.85) << group;
  }
  EXPECT_GT(found.delay_near.share(), 0.9);
  EXPECT_GE(found.right_passed.share(), 0.8);
}

TEST(RandomLogs, numberThatIsOffByFiveTolerancesIsNamed) {
  LogStatistics found;
  addLogs(RandomWrong::one_number, 1001, found);
  std::printf("%s", found.text().c_str());
  ASSERT_GT(found.wrong_named.of, 0);
  EXPECT_GE(found.wrong_named.share(), 0.75);
}

}  // namespace
}  // namespace ursula
