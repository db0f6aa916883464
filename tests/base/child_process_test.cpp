// Child processes: their input, their output, and how they end.

#include "base/child_process.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "base/fresh_paths.h"
#include "tests/base/temporary_folder.h"

namespace ursula {
namespace {

std::string allFrom(int descriptor) {
  std::string all;
  char some[256];
  for (ssize_t got = 0; (got = ::read(descriptor, some, sizeof some)) != 0;)
    if (got > 0) all.append(some, static_cast<std::size_t>(got));
  return all;
}

/// Looks repeatedly, because a killed process may take a moment to end.
bool comesTrue(const std::function<bool()>& what) {
  for (int k = 0; k < 1000 && !what(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return what();
}

TEST(ChildProcess, isAskedAndAnswers) {
  ChildProcess cat({{"cat"}, {}, true});
  EXPECT_TRUE(writeAll(cat.to(), "question"));
  cat.closeInput();
  EXPECT_EQ(allFrom(cat.from()), "question");
  cat.wait();
  EXPECT_EQ(cat.status(), 0);
  EXPECT_EQ(cat.howItEnded(), "ended with exit code 0");
}

TEST(AnswerOf, givesInputLargerThanAPipeAndTakesAsMuch) {
  std::signal(SIGPIPE, SIG_IGN);
  const std::string much(300'000, 'x');
  EXPECT_EQ(answerOf({"cat"}, much), much);
  EXPECT_EQ(answerOf({"sh", "-c", "echo done"}, much), "done\n") << "it need not read";
  EXPECT_THROW(answerOf({"sh", "-c", "cat; exit 3"}, "a"), std::runtime_error);
  EXPECT_THROW(answerOf({"/nowhere/cat"}), std::system_error);
}

TEST(AnswerOf, endsAtItsDeadlineWhetherItReadsOrAnswers) {
  std::signal(SIGPIPE, SIG_IGN);
  for (const char* hangs : {"sleep 1000", "cat >/dev/null; sleep 1000", "echo half; exec >&-; sleep 1000"}) {
    EXPECT_THROW(answerOf({"sh", "-c", hangs}, std::string(300'000, 'x'), Deadline(0.05)), OutOfTime) << hangs;
  }
}

TEST(ChildProcess, hasFurtherVariablesAndOursOtherwise) {
  ::setenv("URSULA_KEPT", "kept", 1);
  ::setenv("URSULA_OTHER", "ours", 1);
  ChildProcess shell({{"sh", "-c", "echo $URSULA_KEPT $URSULA_OTHER"}, {{"URSULA_OTHER", "theirs"}}, false});
  EXPECT_EQ(allFrom(shell.from()), "kept theirs\n");
}

TEST(ChildProcess, saysHowItEnded) {
  const auto ending = [](const std::string& command) {
    ChildProcess shell({{"sh", "-c", command}, {}, false});
    shell.wait();
    EXPECT_NE(shell.status(), 0) << command;
    return shell.howItEnded();
  };
  EXPECT_EQ(ending("exit 3"), "ended with exit code 3");
  EXPECT_EQ(ending("kill -9 $$"), "was ended by signal 9 (Killed)");
}

TEST(ChildProcess, thatThereIsNotIsRefused) {
  try {
    ChildProcess({{"no-such-program-anywhere"}, {}, false});
    FAIL() << "was started";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOENT);
    EXPECT_THAT(error.what(), testing::HasSubstr("no-such-program-anywhere cannot be started"));
  }
}

/// A grandchild would hold the pipe open for long.
TEST(ChildProcess, takesItsGroupWithIt) {
  std::string grandchild;
  {
    ChildProcess shell({{"sh", "-c", "sleep 1000 & echo $!; wait"}, {}, true});
    for (char sign = 0; sign != '\n'; grandchild += sign)
      if (::read(shell.from(), &sign, 1) != 1) break;
    EXPECT_FALSE(shell.hasEnded());
  }
  const pid_t pid = std::stoi(grandchild);
  const auto state = [pid] {
    const std::string stat = TemporaryFolder::read("/proc/" + std::to_string(pid) + "/stat");
    return stat.empty() ? 'X' : stat[stat.rfind(')') + 2];
  };
  EXPECT_TRUE(comesTrue([&] { return state() == 'X' || state() == 'Z'; })) << state();
}

TEST(ChildProcess, isACopyThatWorks) {
  constexpr int here = 41;
  ChildProcess copy([](int from, int to) {
    EXPECT_EQ(allFrom(from), "go");
    writeAll(to, std::to_string(here + 1));
  });
  EXPECT_TRUE(writeAll(copy.to(), "go"));
  copy.closeInput();
  EXPECT_EQ(allFrom(copy.from()), "42");
  copy.wait();
  EXPECT_EQ(copy.status(), 0);
}

TEST(ChildProcess, isACopyWhoseCrashIsItsOwn) {
  ChildProcess copy([](int, int) { throw std::runtime_error("of the work"); });
  copy.wait();
  EXPECT_EQ(copy.howItEnded(), "was ended by signal 6 (Aborted)");
}

TEST(StartDetached, leavesAProcessOfItsOwn) {
  const TemporaryFolder folder;
  const std::string said = (folder.path() / "said").string();
  startDetached(
      {"sh", "-c", "echo lost; ps -o sid= -p $$ >\"$1.new\"; echo $$ >>\"$1.new\"; mv \"$1.new\" \"$1\"", "sh", said});
  ASSERT_TRUE(comesTrue([&] { return std::filesystem::exists(said); }));
  std::istringstream lines(TemporaryFolder::read(said));
  int session = 0, process = -1;
  lines >> session >> process;
  EXPECT_EQ(session, process) << "it leads a session";
}

}  // namespace
}  // namespace ursula
