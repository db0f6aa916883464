// Judges the efforts of a machine with closed loops: judge_fourbar SCENARIO [ERROR]. ERROR is a relative error of them.

#include <ursula/mechanism.h>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

namespace {

int judge(const char* file, double error) {
  //! [judge]
  const ursula::MechanismScenario scenario = ursula::readMechanism(file);
  const ursula::MechanismAlong along(scenario);

  ursula::MechanismSubject mine;
  mine.about = {"mine", ursula::Formulation::external};
  mine.answers = [&](const std::vector<ursula::MechanismQuestion>& questions) {
    std::vector<ursula::MotorEfforts> efforts;  // one for each motor, at each instant
    ursula::LoopWork work;                      // your own code goes here: q, qdot, qddot are in question.motion
    for (const ursula::MechanismQuestion& question : questions)
      efforts.push_back((1 + error) * along.motion().inverseDynamics(question.motion.t, work));
    return efforts;
  };

  const ursula::ValidationResult result = ursula::validateMechanism(scenario, mine);
  std::printf("%s: %s\n", result.scenario.c_str(), ursula::name(result.verdict));
  //! [judge]
  for (const ursula::Check& check : result.checks)
    if (check.verdict == ursula::Verdict::fail) std::printf("%s: %s\n", check.name.c_str(), check.why.c_str());
  return result.verdict == ursula::Verdict::pass ? 0 : 1;
}

/// Shows that direct dynamics takes the efforts back to the accelerations.
void forthAndBack(const char* file) {
  //! [dynamics]
  const ursula::MechanismScenario scenario = ursula::readMechanism(file);
  const ursula::MechanismAlong along(scenario);
  const ursula::LoopSolver& solver = along.solver();
  const double t = 0.5 * scenario.trajectory->duration();
  const ursula::MotorMotion motion = scenario.trajectory->at(t);  // q, qdot, qddot of the motors

  ursula::LoopWork work;
  const Eigen::VectorXd efforts = solver.inverseDynamics(motion, along.motion().near(t), work);
  const Eigen::VectorXd qddot = solver.directDynamics(motion, efforts, along.motion().near(t), work);
  //! [dynamics]
  for (Eigen::Index k = 0; k < efforts.size(); ++k) {
    const auto motor = static_cast<std::size_t>(k);
    std::printf("%s: %.6g %s\n", scenario.mechanism->motor(motor).name.c_str(), efforts(k),
                scenario.mechanism->effortUnit(motor));
  }
  std::printf("accelerations come back within %.1e\n", (qddot - motion.qddot).cwiseAbs().maxCoeff());
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) return 2;
  forthAndBack(argv[1]);
  return judge(argv[1], argc > 2 ? std::atof(argv[2]) : 0);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
