// A time limit: unreached parts are inconclusive with the reason, the rest is judged, and no number depends on the
// limit.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "model/trajectories/trajectories.h"
#include "parts/fast/fast_samples.h"
#include "report/files/report.h"
#include "report/files/written_files.h"
#include "tests/support/matchers.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/families.h"
#include "validation/evidence/background_tasks.h"
#include "validation/evidence/evidence.h"
#include "validation/evidence/reference.h"
#include "validation/replay/observed_order.h"
#include "validation/validate.h"

namespace ursula {
namespace {

Scenario quick() { return scenarioOf("paper-helix", 21); }

ValidationOptions within(double seconds) {
  ValidationOptions options;
  options.time_limit = seconds;
  return options;
}

constexpr double none_at_all = 1e-9, plenty = 1e8;

TEST(BackgroundTasks, areFinishedOnceWhatHasBegunHasEnded) {
  std::atomic<bool> begun{false}, ended{false};
  BackgroundTasks background;
  background.start(1, {[&] {
                     begun = true;
                     std::this_thread::sleep_for(std::chrono::milliseconds(20));
                     ended = true;
                   }});
  while (!begun) std::this_thread::yield();
  background.finish();
  EXPECT_TRUE(ended);
}

TEST(BackgroundTasks, ofAReferenceEndsWithIt) {
  auto reference = makeReference(quick());
  const Deadline deadline = reference->deadline;
  EXPECT_NO_THROW(deadline.require());
  reference.reset();
  EXPECT_THROW(deadline.require(), OutOfTime) << "what is under way asks, and ends";
}

TEST(TimeLimit, holdsForTheObservedOrders) {
  int asked = 0;
  EXPECT_FALSE(observedOrders(quick(), false, Deadline(0, [&asked] { return ++asked < 0; })).empty());
  EXPECT_GT(asked, 100) << "at every step";
  asked = 0;
  EXPECT_THROW(observedOrders(quick(), false, Deadline(0, [&asked] { return ++asked > 10; })), OutOfTime);
}

/// No experiment that takes long goes on. A subject is asked for another machine's torques, too.
TEST(TimeLimit, holdsForEveryInstantOfAnExperiment) {
  const Scenario scenario = quick();
  std::atomic<int> rebuilt{0};
  std::atomic<bool> over{false};
  const Deadline deadline(0, [&over] { return over.load(); });
  Subject subject = nocSubject(*scenario.manipulator, nullptr);
  subject.rebuilt = [&, build = subject.rebuilt](const Manipulator& machine) {
    return changedTorques(build(machine),
                          [&](const auto&, const Vector6d& torques) { return over = ++rebuilt >= 3, torques; });
  };
  ValidationOptions options;
  options.reference = makeReference(scenario, 1, deadline);
  const ValidationResult result = validate(scenario, subject, options);
  EXPECT_EQ(rebuilt, 3);
  EXPECT_EQ(verdictOf(result.checks, "invariance.rotation"), "inconclusive");
  over = false;
  const auto reference = makeReference(scenario, 1, deadline);
  reference->rounding();
  over = true;
  EXPECT_THROW(reference->reactions(), OutOfTime);
}

void expectAllUnfinished(const ValidationResult& result) {
  EXPECT_EQ(result.verdict, Verdict::inconclusive) << others(result.checks, Verdict::inconclusive);
  std::size_t unfinished = 0;
  for (const Check& check : result.checks)
    if (check.reason == Reason::unfinished) {
      ++unfinished;
      EXPECT_EQ(check.why, "the time limit of 1e-09 s was reached") << check.name;
    }
  EXPECT_GE(unfinished, 10U);
  for (const char* name : {"torque.pointwise", "replay.position", "energy.balance"})
    EXPECT_EQ(verdictOf(result.checks, name), "inconclusive") << name;
}

/// It was measured that a sample takes some 30 evaluations of the loop, and that few samples take little of a whole
/// validation.
TEST(Work, isForetoldByTheNumberOfSamples) {
  Scenario scenario = quick();
  const WorkParts few = workParts(scenario);
  EXPECT_LT(few.samples, 0.1 * few.total());
  constexpr int many = 100'000;
  scenario.simulation.samples = many;
  const WorkParts parts = workParts(scenario);
  EXPECT_GT(parts.samples, 0.8 * parts.total());
  EXPECT_GT(parts.total() - few.total(), 20.0 * many);
  EXPECT_LT(parts.total() - few.total(), 50.0 * many);
}

TEST(Work, isSaidAsItIsDone) {
  std::vector<double> shares;
  ValidationOptions options;
  options.progress = [&shares](double share, const char*) { shares.push_back(share); };
  Scenario scenario = quick();
  validate(scenario, options);
  ASSERT_GE(shares.size(), 8U) << "also between the experiments at the samples";
  EXPECT_EQ(shares.front(), 0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_LT(shares.back(), 1);
  EXPECT_NEAR(shares[1], workParts(scenario).reference / workParts(scenario).total(), 1e-12);
}

TEST(TimeLimit, leavesAReportWhereNothingWasReached) {
  expectAllUnfinished(validate(quick(), within(none_at_all)));
  const Scenario scenario = quick();
  expectAllUnfinished(validate(scenario, nocSubject(*scenario.manipulator, nullptr), within(none_at_all)));
}

/// Time is up after 200 answers, in the replays.
TEST(TimeLimit, judgesWhatWasReached) {
  const Scenario scenario = quick();
  std::atomic<int> asked{0};
  const Subject subject =
      changedTorques(solverOf(scenario), [&asked](const auto&, const Vector6d& torques) { return ++asked, torques; });
  ValidationOptions options;
  options.asked_to_end = [&asked] { return asked > 200; };
  const ValidationResult result = validate(scenario, subject, options);
  const auto found = [&](const char* name) { return verdictOf(result.checks, name); };
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_EQ(found("torque.pointwise"), "pass");
  EXPECT_EQ(found("replay.position"), "inconclusive");
  EXPECT_EQ(result.timeseries.rows(), 21U);
}

/// The last experiment finds the error's sources, which decides nothing. A foreign solver's answers are judged after
/// it, too.
TEST(TimeLimit, keepsWhatWasJudgedWhereTimeIsUpAfterIt) {
  const Scenario scenario = quick();
  for (const Formulation formulation : {Formulation::noc, Formulation::external}) {
    Subject subject = nocSubject(*scenario.manipulator, nullptr);
    subject.formulation = formulation;
    std::atomic<bool> over{false};
    const Deadline deadline(0, [&over] { return over.load(); });
    ValidationOptions options;
    options.reference = makeReference(scenario, 1, deadline);
    options.progress = [&](double, const std::string& now) {
      if (now == "sources of the error") over = true;
    };
    const ValidationResult result = validate(scenario, subject, options);
    ASSERT_TRUE(over);
    EXPECT_EQ(result.verdict, Verdict::pass) << name(formulation) << others(result.checks, Verdict::pass);
    EXPECT_EQ(result.timeseries.rows(), 21U);
  }
}

/// Kernels that were not asked because time was up are not wrong; kernels that were not asked for another reason are.
TEST(TimeLimit, judgesNoKernelsThatWereNotAsked) {
  const auto& families = checkFamilies();
  const auto fast = std::find_if(families.begin(), families.end(),
                                 [](const CheckFamily& each) { return std::string(each.id) == "fast kernels"; });
  ASSERT_NE(fast, families.end());
  Evidence evidence;
  evidence.samples.resize(1);
  EXPECT_FALSE(fast->applies(evidence)) << "without the experiment";
  const auto kernels = std::make_shared<FastSamples>();
  evidence.witnessed["fast kernels"] = kernels;
  EXPECT_TRUE(fast->applies(evidence));
  evidence.has.out_of_time = "the time limit of 1 s was reached";
  EXPECT_FALSE(fast->applies(evidence));
  kernels->refused = "the pose is singular";
  EXPECT_TRUE(fast->applies(evidence));
}

/// Before any experiment, all is unfinished but what the scenario or the subject lacks.
TEST(TimeLimit, saysOfEachCheckWhyItIsMissing) {
  Scenario scenario = quick();
  scenario.load = std::make_shared<const Load>();
  ValidationOptions options;
  options.time_limit = none_at_all;
  Subject torques = nocSubject(*scenario.manipulator, nullptr);
  const ValidationResult whole = validate(scenario, torques, options);
  torques.complement = nullptr;
  const ValidationResult less = validate(scenario, torques, options);
  for (const char* name :
       {"motion.load", "complement.rank", "reactions.pointwise", "integration.second", "replay.position"}) {
    EXPECT_EQ(findCheck(whole.checks, name)->reason, Reason::unfinished) << name;
    EXPECT_THAT(findCheck(whole.checks, name)->why, HasSubstr("time limit")) << name;
  }
  EXPECT_EQ(findCheck(less.checks, "complement.rank")->why, "the subject forms no T");
  EXPECT_EQ(verdictOf(less.checks, "complement.rank"), "not_applicable");
}

TEST(TimeLimit, holdsForTorquesOfAFile) {
  const Scenario scenario = quick();
  TorqueFile file;
  file.file = "tau.csv";
  const Subject right = nocSubject(*scenario.manipulator, nullptr);
  for (int k = 0; k <= 30; ++k) {
    file.t.push_back(scenario.trajectory->duration() * k / 30);
    file.torques.push_back(right.torques(scenario.trajectory->at(file.t.back())));
    file.time_precision.push_back(0);
    file.torque_precision.push_back(Vector6d::Zero());
  }
  const ValidationResult result = validateExternal(scenario, file, none_at_all);
  EXPECT_EQ(result.verdict, Verdict::inconclusive) << others(result.checks, Verdict::inconclusive);
  EXPECT_EQ(verdictOf(result.checks, "torque.pointwise"), "inconclusive");
  EXPECT_EQ(verdictOf(result.checks, "torque.twin"), "not_applicable") << "a file has none, however long it takes";
}

/// Every experiment that may be long is asked alone, also where it turns the machine's own errors into results.
TEST(TimeLimit, endsEachExperiment) {
  const Scenario scenario = quick();
  const Deadline over(none_at_all);
  const std::vector<double> instants = {0, 1, 2};
  const Subject noc = nocSubject(*scenario.manipulator, nullptr);
  const SimbodyLoop::TorqueHistory torques = [&](double t) { return noc.torques(scenario.trajectory->at(t)); };
  EXPECT_THROW(RoundingProfile(scenario, 3, over), OutOfTime);
  EXPECT_THROW(linearised(scenario, over), OutOfTime);
  EXPECT_THROW(simbodyAnswers(scenario, instants, over), OutOfTime);
  EXPECT_THROW(engineTorques(scenario, instants, over), OutOfTime);
  EXPECT_THROW(runPointwise(scenario, noc, instants, over), OutOfTime);
  for (const Integrator integrator : {Integrator::rkf78, Integrator::rk_merson}) {
    ReplaySettings settings;
    settings.integrator = integrator;
    settings.end = 0.1;
    EXPECT_TRUE(replay(scenario, torques, settings).gave_up.empty());
    settings.deadline = over;
    EXPECT_THROW(replay(scenario, torques, settings), OutOfTime) << name(integrator);
  }
}

TEST(Deadline, isOverForItsCopiesUntilItIsRemoved) {
  const Deadline over(none_at_all), copy = over;
  EXPECT_TRUE(copy.isOver());
  EXPECT_THROW(over.require(), OutOfTime);
  copy.remove();
  EXPECT_NO_THROW(over.require());
  EXPECT_NO_THROW(Deadline().require());
  EXPECT_NO_THROW(Deadline(plenty).require());
}

TEST(Deadline, endsAPartAloneOrWithTheWhole) {
  const Deadline whole(plenty), part = whole.part();
  EXPECT_FALSE(part.isOver());
  part.end();
  EXPECT_TRUE(part.isOver());
  EXPECT_FALSE(whole.isOver());
  EXPECT_TRUE(Deadline(none_at_all).part().isOver());
  EXPECT_FALSE(Deadline().part().isOver());
}

/// A host asks the run to end after a few questions, and the run obeys at any time.
TEST(TimeLimit, isReachedOnceItIsAskedToEnd) {
  for (const int last : {0, 10, 5000}) {
    int asked = 0;
    ValidationOptions options;
    options.asked_to_end = [&] { return ++asked > last; };
    const ValidationResult result = validate(quick(), options);
    EXPECT_EQ(result.verdict, Verdict::inconclusive) << last;
    EXPECT_TRUE(std::any_of(result.checks.begin(), result.checks.end(), [](const Check& check) {
      return check.reason == Reason::unfinished && check.why == "it was asked to end";
    })) << last;
  }
  ValidationOptions never = within(plenty);
  never.asked_to_end = [] { return false; };
  EXPECT_EQ(report::summaryJson(validate(quick(), never)), report::summaryJson(validate(quick()))) << "or no number";
}

/// 1e300 s would overflow the clock.
TEST(Deadline, takesAnyLength) { EXPECT_FALSE(Deadline(1e300).isOver()); }

/// A motion of a thousand years has a bounded number of intervals.
TEST(TimeLimit, endsAMotionWithoutEnd) {
  const Scenario hold = readScenario(URSULA_SCENARIOS "/hold.toml");
  Scenario scenario = hold;
  scenario.simulation.samples = 5;
  const Motion<double> pose = hold.trajectory->at(0);
  const Eigen::Quaterniond q(pose.Q);
  scenario.trajectory = makeHold(pose.p, {q.w(), q.x(), q.y(), q.z()}, 3e10);
  EXPECT_EQ(validate(scenario, within(1)).verdict, Verdict::inconclusive);
}

}  // namespace
}  // namespace ursula
