// Processes that work on points, and crashes of these.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <map>

#include "parts/sweep/worker_pool.h"
#include "tests/base/temporary_folder.h"

namespace ursula {
namespace {

SweepPoint answer(std::int64_t id) {
  return {id, "{}", "pass", 0.25, "", {{"square", double(id) * double(id), 1, "pass"}}};
}

/// Runs `work` on all points of [0, count), handed out by `handful`; returns the results by id.
std::map<std::int64_t, SweepPoint> run(int workers, std::int64_t count, std::int64_t handful,
                                       const std::function<SweepPoint(std::int64_t)>& work) {
  std::map<std::int64_t, SweepPoint> out;
  std::int64_t next = 0;
  WorkerTasks tasks;
  tasks.next = [&] {
    const std::int64_t from = next;
    next = std::min(count, next + handful);
    return PointRange{from, next};
  };
  tasks.makeWork = [&] { return work; };
  tasks.parameters = [](std::int64_t id) { return "p" + std::to_string(id); };
  tasks.done = [&](const SweepPoint& point) {
    EXPECT_TRUE(out.emplace(point.id, point).second) << "twice: " << point.id;
  };
  tasks.stop = [] { return false; };
  EXPECT_TRUE(runWorkers(workers, tasks));
  return out;
}

TEST(WorkerPool, makesEachPointOnceWhateverTheNumberOfWorkers) {
  for (const int workers : {1, 2, 7}) {
    const auto found = run(workers, 1000, 9, answer);
    ASSERT_EQ(found.size(), 1000u);
    for (const auto& [id, point] : found) EXPECT_EQ(point.values[0].value, double(id) * double(id));
  }
}

TEST(WorkerPool, triesAPointThatCrashesOnceMoreAndGoesOn) {
  for (const int signal : {SIGABRT, SIGKILL}) {
    const auto found = run(2, 100, 8, [signal](std::int64_t id) {
      if (id == 13 || id == 14 || id == 99) ::raise(signal);
      return answer(id);
    });
    ASSERT_EQ(found.size(), 100u);
    for (const auto& [id, point] : found) {
      const bool crashes = id == 13 || id == 14 || id == 99;
      EXPECT_EQ(point.verdict, crashes ? "error" : "pass") << id;
      if (!crashes) continue;
      EXPECT_THAT(point.error, testing::HasSubstr("ended by signal " + std::to_string(signal))) << id;
      EXPECT_EQ(point.parameters, "p" + std::to_string(id));
    }
  }
}

TEST(WorkerPool, whatCrashesOnceHasItsResult) {
  const TemporaryFolder folder;
  const std::filesystem::path mark = folder.path() / "tried";
  const auto found = run(1, 10, 3, [&](std::int64_t id) {
    if (id == 4 && !std::filesystem::exists(mark)) {
      folder.write("tried", "");
      ::_exit(7);
    }
    return answer(id);
  });
  ASSERT_EQ(found.size(), 10u);
  EXPECT_EQ(found.at(4).verdict, "pass");
  EXPECT_TRUE(std::filesystem::exists(mark));
}

TEST(WorkerPool, stopsWhenAskedTo) {
  WorkerTasks tasks;
  std::int64_t next = 0;
  int done = 0;
  tasks.next = [&] { return PointRange{next, next + 1}; };
  tasks.makeWork = [] { return answer; };
  tasks.parameters = [](std::int64_t) { return ""; };
  tasks.done = [&](const SweepPoint&) { ++next, ++done; };
  tasks.stop = [&] { return done >= 5; };
  EXPECT_FALSE(runWorkers(2, tasks));
  EXPECT_GE(done, 5);
}

TEST(Wire, carriesWholePointsFromPieces) {
  SweepPoint sent = answer(-3);
  sent.error = std::string("text with \0 and \n", 17);
  const std::string bytes = packed(sent) + packed(answer(8));
  std::string arrived;
  std::vector<SweepPoint> got;
  for (const char byte : bytes) {
    arrived += byte;
    for (const SweepPoint& point : takePoints(arrived)) got.push_back(point);
  }
  ASSERT_EQ(got.size(), 2u);
  EXPECT_EQ(got[0].id, -3);
  EXPECT_EQ(got[1].id, 8);
  EXPECT_EQ(got[0].error, sent.error);
  EXPECT_EQ(got[1].error, "");
  EXPECT_EQ(got[1].values[0].name, "square");
  EXPECT_EQ(got[1].values[0].value, 64);
}

}  // namespace
}  // namespace ursula
