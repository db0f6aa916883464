// Torques along the commanded motion, and back: inverse_dynamics SCENARIO

#include <ursula/ursula.h>
#include <algorithm>
#include <cstdio>
#include <exception>

namespace {

int printTorques(const char* file) {
  //! [loop]
  const ursula::Scenario scenario = ursula::readScenario(file);
  const ursula::Solver<double> solver(*scenario.manipulator);
  ursula::Workspace<double> work;  // one for each thread; nothing in the loop allocates
  double largest = 0;
  for (int k = 0; k <= 10; ++k) {
    const ursula::Motion<double> motion = scenario.trajectory->at(k * scenario.trajectory->duration() / 10);
    const ursula::Vector6d tau = solver.inverseDynamics(motion, work);
    // Direct dynamics: the same torques give the commanded [ω̇; p̈] back.
    const ursula::Vector6d found = solver.directDynamics(motion, tau, work);
    largest = std::max(largest, (found.tail<3>() - motion.p_ddot).norm());
    std::printf("%.3f s: %10.3f %10.3f %10.3f %10.3f %10.3f %10.3f N m\n", motion.t, tau(0), tau(1), tau(2), tau(3),
                tau(4), tau(5));
  }
  //! [loop]
  std::printf("accelerations come back within %.1e m/s^2\n", largest);
  return largest < 1e-9 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  return argc < 2 ? 2 : printTorques(argv[1]);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
