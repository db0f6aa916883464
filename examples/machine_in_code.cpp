// A machine and a motion without a file, judged and written: machine_in_code FOLDER [ERROR]. ERROR, relative, is put
// into the motion's velocity, which then is no derivative of its position.

#include <ursula/ursula.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

namespace {

//! [machine]
/// Six equal legs in three pairs, 120° apart; the axes are tangents of the base's circle.
ursula::ManipulatorParameters machine() {
  ursula::ManipulatorParameters out;
  out.platform.mass = 300;
  out.platform.center_of_mass = {0, 0, 0.1};
  out.platform.inertia = ursula::Vector3d(60, 60, 110).asDiagonal();
  for (std::size_t i = 0; i < ursula::leg_count; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1, middle = 2 * M_PI / 3 * static_cast<double>(i / 2);
    const double base = middle + sign * 0.15, platform = middle + sign * 0.75;
    ursula::Leg& leg = out.legs[i];
    leg.base_point = {2 * std::cos(base), 2 * std::sin(base), 0};
    leg.base_axis = {-std::sin(base), std::cos(base), 0};
    leg.platform_point = {std::cos(platform), std::sin(platform), 0};
    leg.proximal = {1.4, 10, 0.7, ursula::Vector3d(1.7, 1.7, 0.02).asDiagonal()};
    leg.distal = leg.proximal;
  }
  return out;
}
//! [machine]

//! [trajectory]
/// Up and down by 0.1 m, once in two seconds.
class Heave : public ursula::Trajectory {
 public:
  explicit Heave(double error) : error_(error) {}
  std::string kind() const override { return "heave"; }
  double duration() const override { return 2; }
  ursula::Motion<double> at(double t) const override {
    ursula::Motion<double> motion;
    motion.t = t;
    motion.p.z() = 1.9 - 0.1 * std::cos(M_PI * t);
    motion.p_dot.z() = (1 + error_) * 0.1 * M_PI * std::sin(M_PI * t);
    motion.p_ddot.z() = 0.1 * M_PI * M_PI * std::cos(M_PI * t);
    return motion;
  }

 private:
  double error_;
};
//! [trajectory]

int judge(const char* folder, double error) {
  //! [scenario]
  ursula::Scenario scenario;
  scenario.name = "heave";
  scenario.manipulator = std::make_shared<const ursula::Manipulator>(machine());
  scenario.trajectory = std::make_shared<const Heave>(error);
  const ursula::ValidationResult result = ursula::validate(scenario);
  ursula::writeResults(result, folder);
  //! [scenario]
  std::printf("%s: %s, report at %s/report.html\n", result.scenario.c_str(), ursula::name(result.verdict), folder);
  for (const ursula::Check& check : result.checks)
    if (check.verdict != ursula::Verdict::pass) std::printf("%s: %s\n", check.name.c_str(), check.why.c_str());
  return result.verdict == ursula::Verdict::pass ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  return argc < 2 ? 2 : judge(argv[1], argc > 2 ? std::atof(argv[2]) : 0);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
