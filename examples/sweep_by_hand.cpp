// The largest torque over the platform's mass: sweep_by_hand SCENARIO

#include <ursula/ursula.h>
#include <algorithm>
#include <cstdio>
#include <exception>

namespace {

double largestTorque(const ursula::Manipulator& manipulator, const ursula::Trajectory& trajectory) {
  const ursula::Solver<double> solver(manipulator);
  ursula::Workspace<double> work;
  double largest = 0;
  for (double t : ursula::equallySpaced(trajectory.duration(), 101))
    largest = std::max(largest, solver.inverseDynamics(trajectory.at(t), work).cwiseAbs().maxCoeff());
  return largest;
}

int sweep(const char* file) {
  //! [sweep]
  const ursula::Scenario scenario = ursula::readScenario(file);
  ursula::ManipulatorParameters parameters = scenario.manipulator->parameters();
  double before = 0;
  for (double mass = 400; mass <= 600; mass += 50) {
    parameters.platform.mass = mass;
    const ursula::Manipulator changed(parameters);  // checked: throws InvalidParameter for what no machine can have
    const double torque = largestTorque(changed, *scenario.trajectory);
    std::printf("%.0f kg: %.1f N m\n", mass, torque);
    if (torque <= before) return 1;  // a heavier platform asks for more
    before = torque;
  }
  //! [sweep]
  return 0;
}

}  // namespace

int main(int argc, char** argv) try { return argc < 2 ? 2 : sweep(argv[1]); } catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
