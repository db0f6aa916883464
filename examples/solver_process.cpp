// A solver as a process: ursula validate SCENARIO --solver 'solver_process [ERROR]'. Each line of standard input is
// t, p, q, v, w, a, alpha, 20 values with commas between; it is answered with a line of six torques. ERROR is put into
// them, relative. The torques are this library's own here; yours need no library at all.

#include <ursula/scenario.h>
#include <ursula/solver.h>
#include <ursula/validate.h>
#include <Eigen/Geometry>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

namespace {

ursula::Motion<double> motionOf(const std::string& line) {
  std::array<double, 20> value{};
  const char* at = line.c_str();
  for (double& each : value) {
    char* end = nullptr;
    each = std::strtod(at, &end);
    at = end + (*end == ',' ? 1 : 0);
  }
  const auto vector = [&value](std::size_t first) {
    return ursula::Vector3d(value[first], value[first + 1], value[first + 2]);
  };
  ursula::Motion<double> motion;
  motion.t = value[0];
  motion.p = vector(1);
  motion.Q = Eigen::Quaterniond(value[4], value[5], value[6], value[7]).normalized().toRotationMatrix();
  motion.p_dot = vector(8);
  motion.omega = vector(11);
  motion.p_ddot = vector(14);
  motion.omega_dot = vector(17);
  return motion;
}

int answerAll(const char* file, double error) {
  const ursula::Scenario scenario = ursula::readScenario(file);
  const ursula::Solver<double> solver(*scenario.manipulator);
  ursula::Workspace<double> work;
  for (std::string line; std::getline(std::cin, line);) {
    const ursula::Motion<double> motion = motionOf(line);
    const ursula::Vector6d load = ursula::loadAtP(scenario.load.get(), motion);
    const ursula::Vector6d tau = (1 + error) * solver.inverseDynamics(motion, work, load);
    std::printf("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", tau(0), tau(1), tau(2), tau(3), tau(4), tau(5));
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const char* file = std::getenv("URSULA_SCENARIO");
  return file == nullptr ? 2 : answerAll(file, argc > 1 ? std::atof(argv[1]) : 0);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
