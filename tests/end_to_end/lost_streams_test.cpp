// A lost terminal does not end the program; lost data is reported.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/quick_runs.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(LostTerminal, isNoReasonToStop) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("two"));
  const std::string call = "\"$URSULA\" validate a.toml b.toml --out out >said";
  ASSERT_EQ(shell(ursula, call + " 2>/dev/null"), 0);
  const auto expected = contents(ursula.folder() / "out");
  for (const std::string& lost : {call + " 2>&-", call + " 2>/dev/full", call + " <&- 2>&-",
                                  "{ " + call + " 2>&3; echo $? >code; } 3>&1 | true; exit $(cat code)"}) {
    fs::remove_all(ursula.folder() / "out");
    EXPECT_EQ(shell(ursula, lost), 0) << lost;
    EXPECT_TRUE(contents(ursula.folder() / "out") == expected) << lost;
    EXPECT_THAT(TemporaryFolder::read(ursula.folder() / "said"), HasSubstr("2 passed, 0 failed")) << lost;
  }
}

TEST(LostData, isExit2AndSaidOnWhatIsLeft) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("two"));
  for (const char* call : {"validate a.toml", "validate a.toml --json", "validate a.toml b.toml --json",
                           "inverse a.toml", "check a.toml", "explain", "--help"})
    for (const char* lost : {">/dev/full", ">&-"}) {
      const std::string line = std::string("\"$URSULA\" ") + call + " " + lost;
      EXPECT_EQ(shell(ursula, line + " 2>err"), 2) << line;
      EXPECT_THAT(TemporaryFolder::read(ursula.folder() / "err"),
                  HasSubstr("error: standard output could not be written"))
          << line;
    }
  for (const char* both : {">/dev/full 2>&-", ">&- 2>&-"})
    EXPECT_EQ(shell(ursula, std::string("\"$URSULA\" inverse a.toml ") + both), 2) << both;
  EXPECT_EQ(shell(ursula, "\"$URSULA\" inverse a.toml >/dev/null 2>err"), 0) << "what is thrown away is not lost";
  EXPECT_THAT(TemporaryFolder::read(ursula.folder() / "err"), IsEmpty());
}

}  // namespace
}  // namespace ursula
