// Causes that are known are put into exact torques: nearly all must be the first that is named, and none named wrongly.

#include "tests/validation/injected_causes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/whole.h"

namespace ursula {
namespace {

TEST(InjectedCauses, areNamedFirstAndNeverWronglyWithConfidence) {
  const int every = wholeAsked() ? 1 : 4;
  const std::vector<InjectedCause> causes = diagnoseInjectedCauses(every);
  std::size_t named = 0, with_a_cause = 0;
  for (const InjectedCause& one : causes) {
    EXPECT_FALSE(one.isWrong()) << one.scenario << ": " << one.put_in << ": " << one.said;
    if (one.expected.empty()) continue;
    ++with_a_cause;
    named += one.isNamedFirst() ? 1 : 0;
  }
  EXPECT_GE(every * with_a_cause, 60U);
  EXPECT_GE(10 * named, 9 * with_a_cause);
}

TEST(InjectedCauses, areHeldAgainstWhatWasSaid) {
  const InjectedCause right{"s", "p", "platform mass", "platform mass 510 kg, which explains 100 %"};
  const InjectedCause wrong{"s", "p", "platform mass", "gravity left out, which explains 100 %"};
  const InjectedCause careful{"s", "p", "platform mass", "a likely part: gravity left out"};
  const InjectedCause second{"s", "p", "mass", "gravity; as well explained by: mass"};
  EXPECT_TRUE(right.isNamedFirst());
  EXPECT_FALSE(right.isWrong());
  EXPECT_TRUE(wrong.isWrong());
  EXPECT_FALSE(careful.isWrong());
  EXPECT_FALSE(second.isNamedFirst());
}

}  // namespace
}  // namespace ursula
