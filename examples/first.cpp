#include <ursula/ursula.h>
#include <iostream>

int main() {
  ursula::Subject mine;
  mine.name = "mine";
  mine.torques = [](const ursula::Motion<double>& /*p, Q, p_dot, omega, p_ddot, omega_dot*/) -> ursula::Vector6d {
    return ursula::Vector6d::Zero();  // your code: six efforts at this instant
  };
  const ursula::ValidationResult result = ursula::validate(ursula::readScenario("my.toml"), mine);
  std::cout << ursula::name(result.verdict) << '\n';
  ursula::writeResults(result, "results/mine");
}
