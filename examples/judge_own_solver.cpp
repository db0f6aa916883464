// Judges a solver of your own: judge_own_solver SCENARIO [ERROR]. ERROR is a relative error of its torques.

#include <ursula/ursula.h>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

int judge(const char* file, double error) {
  //! [judge]
  const ursula::Scenario scenario = ursula::readScenario(file);
  const ursula::Solver<double> solver(*scenario.manipulator);

  ursula::Subject mine;
  mine.name = "mine";
  mine.torques = [&](const ursula::Motion<double>& motion) -> ursula::Vector6d {
    ursula::Workspace<double> work;  // your own code goes here
    return (1 + error) * solver.inverseDynamics(motion, work);
  };

  const ursula::ValidationResult result = ursula::validate(scenario, mine);
  std::printf("%s: %s\n", result.scenario.c_str(), ursula::name(result.verdict));
  for (const ursula::Check& check : result.checks)
    if (check.verdict != ursula::Verdict::pass) std::printf("%s: %s\n", check.name.c_str(), check.why.c_str());
  return result.verdict == ursula::Verdict::pass ? 0 : 1;
  //! [judge]
}

}  // namespace

int main(int argc, char** argv) try {
  return argc < 2 ? 2 : judge(argv[1], argc > 2 ? std::atof(argv[2]) : 0);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
