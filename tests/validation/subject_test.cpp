// Many threads ask subjects at once, and each gets the answer that it would get alone.

#include "validation/subject/subject.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/support/motions.h"
#include "tests/validation/scenario_files.h"
#include "tests/validation/transformed_numbers.h"
#include "validation/subject/frame_change.h"

namespace ursula {
namespace {

/// All answers of a subject at one motion.
struct Answers {
  Vector6d torques, accelerations, rebuilt;
  Numbers joints, bodies;
  Matrix6d T, T_rate;

  bool operator==(const Answers& other) const {
    return torques == other.torques && accelerations == other.accelerations && rebuilt == other.rebuilt &&
           joints == other.joints && bodies == other.bodies && T == other.T && T_rate == other.T_rate;
  }
};

Answers ask(const Subject& subject, const Manipulator& machine, const Motion<double>& motion) {
  Answers out;
  out.torques = subject.torques(motion);
  const KinematicAnswer kinematics = subject.kinematics(motion);
  out.joints = numbersOf(kinematics.joints);
  out.bodies = numbersOf(kinematics.bodies);
  out.T = kinematics.T;
  out.T_rate = kinematics.T_rate;
  out.accelerations = subject.accelerations(motion, 1.5 * out.torques);
  out.rebuilt = subject.rebuilt(machine).torques(motion);
  return out;
}

/// Subjects of two machines, right and altered, transformed and not, with motions of each.
class Asked {
 public:
  Asked() {
    SeededDraws dice(5);
    for (const char* name : {"proving-ground", "paper-helix"}) {
      scenarios_.push_back(scenarioOf(name));
      for (int k = 0; k < 40; ++k) motions_.push_back(randomState(scenarios_.back(), dice));
    }
    for (const Scenario& scenario : scenarios_) {
      const Subject right = solverOf(scenario);
      subjects_.push_back({right,
                           wrongNocSubject(*scenario.manipulator, scenario.load, WithFormulaErrors(FormulaError::eq47)),
                           transformed(right, FrameChange(*scenario.manipulator))});
    }
  }

  std::vector<Answers> all() const {
    std::vector<Answers> out;
    for (std::size_t k = 0; k < motions_.size(); ++k)
      for (std::size_t s = 0; s < 3; ++s) {
        const std::size_t m = k / 40;
        out.push_back(ask(subjects_[m][s], *scenarios_[m].manipulator, motions_[k]));
      }
    return out;
  }

 private:
  std::vector<Scenario> scenarios_;
  std::vector<Motion<double>> motions_;
  std::vector<std::vector<Subject>> subjects_;
};

TEST(Subjects, answerManyThreadsAsTheyAnswerOne) {
  const Asked asked;
  const std::vector<Answers> alone = asked.all();
  EXPECT_FALSE(alone[0] == alone[1]) << "the error changes nothing";
  EXPECT_FALSE(alone[0] == alone[3]) << "motions change nothing";
  std::vector<std::future<std::vector<Answers>>> threads;
  for (int k = 0; k < 6; ++k) threads.push_back(std::async(std::launch::async, [&asked] { return asked.all(); }));
  for (auto& thread : threads) {
    const std::vector<Answers> there = thread.get();
    ASSERT_EQ(there.size(), alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_TRUE(there[k] == alone[k]) << k;
  }
}

}  // namespace
}  // namespace ursula
