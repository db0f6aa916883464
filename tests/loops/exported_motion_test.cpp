// Hexapods written as models and read back as mechanisms: the motors' angles of their motion continue the file's.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "model/instants.h"
#include "nocsolver/noc/noc.h"
#include "parts/exchange/write/export.h"
#include "tests/base/temporary_folder.h"
#include "tests/loops/loop_scenario.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

/// A scenario of the repository as a mechanism, with its motors' motion by 201 rows.
MechanismScenario exported(const TemporaryFolder& folder, const std::string& name) {
  const Scenario scenario = readScenario(URSULA_LOOPS "../../../scenarios/" + name + ".toml");
  folder.write("machine.xml", exchange::exportScenario(scenario, exchange::ModelFormat::mjcf).text);
  std::string text =
      "name = \"m\"\n[mechanism]\nfile = \"machine.xml\"\n[trajectory]\nkind = \"hold\"\nduration = 1\nmotors = [";
  const Noc<double> noc(*scenario.manipulator);
  NocWorkspace<double> work;
  const std::vector<double> t = equallySpaced(scenario.trajectory->duration(), 201);
  Eigen::MatrixXd q(201, 6);
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    noc.inverseKinematics(scenario.trajectory->at(t[static_cast<std::size_t>(i)]), work);
    q.row(i) = noc.angles(work).driven(scenario.manipulator->motors()).transpose();
  }
  for (Eigen::Index k = 0; k < 6; ++k) text += std::to_string(q(0, k)) + ", ";
  MechanismScenario out = parseMechanism(text + "]\n", folder.path() / "m.toml");
  out.trajectory = makeMotorSamples(t, q);
  return out;
}

ValidationResult judgedTimes(const MechanismScenario& scenario, double factor) {
  const MechanismAlong along(scenario);
  auto given = std::make_shared<GivenEfforts>();
  given->name = "mine.csv";
  LoopWork work;
  for (const double t : equallySpaced(scenario.trajectory->duration(), 41)) {
    given->t.push_back(t);
    given->efforts.emplace_back(factor * along.motion().inverseDynamics(t, work));
    given->precision.emplace_back(MotorEfforts::Zero(6));
  }
  MechanismSubject subject;
  subject.about = {"mine.csv", Formulation::external, CalledBy::torques};
  subject.given = given;
  return validateMechanism(scenario, subject);
}

/// Straight from the end of the motion to its start the loops lead through a singular pose.
TEST(ExportedMotion, ThatEndsNearASingularPoseIsJudged) {
  const TemporaryFolder folder;
  const MechanismScenario scenario = exported(folder, "near-singular");
  EXPECT_NE(judgedTimes(scenario, 1).verdict, Verdict::fail);
  EXPECT_EQ(judgedTimes(scenario, 1.001).verdict, Verdict::fail);
}

TEST(ExportedMotion, OfCranksContinuesTheFilesPose) {
  const TemporaryFolder folder;
  const MechanismScenario scenario = exported(folder, "hexa");
  EXPECT_EQ(judgedTimes(scenario, 1).verdict, Verdict::pass);
  EXPECT_EQ(judgedTimes(scenario, 1.001).verdict, Verdict::fail);
}

}  // namespace
}  // namespace ursula
