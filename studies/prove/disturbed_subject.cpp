#include <fmt/format.h>

#include "studies/prove/defects.h"

namespace ursula {

Subject disturbedSubject(const Scenario& scenario, const Parameter& parameter, double relative) {
  const auto rebuilt = [&parameter, relative](const Manipulator& manipulator) {
    ManipulatorParameters machine = manipulator.parameters();
    parameter.disturb(machine, relative);
    return Manipulator(machine);
  };
  Subject subject = nocSubject(rebuilt(*scenario.manipulator), scenario.load);
  subject.name = fmt::format("noc with {} off by {:g}", parameter.path, relative);
  return subject;
}

}  // namespace ursula
