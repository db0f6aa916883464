#include "tests/model/second_reading/second_reading.h"

#include <fmt/format.h>

#include <algorithm>

namespace ursula {
namespace {

void compareLink(const std::string& place, const Link& read, const Link& written, Mismatches& mismatches) {
  mismatches.number(place + ".length", read.length, written.length);
  mismatches.number(place + ".mass", read.mass, written.mass);
  mismatches.number(place + ".center_of_mass", read.center_of_mass, written.center_of_mass);
  mismatches.numbers(place + ".off_line", read.off_line, written.off_line);
  mismatches.numbers(place + ".inertia", read.inertia.reshaped(), written.inertia.reshaped());
}

void compareFriction(const std::string& place, const JointFriction& read, const JointFriction& written,
                     Mismatches& mismatches) {
  mismatches.number(place + ".phi", read.phi, written.phi);
  mismatches.number(place + ".psi", read.psi, written.psi);
  mismatches.number(place + ".theta", read.theta, written.theta);
  mismatches.number(place + ".d", read.d, written.d);
}

/// The driven joints as a text, with "1" for each that has a motor.
std::string motorsOf(const Leg& leg) {
  std::string out;
  for (const bool driven : leg.actuated) out += driven ? '1' : '0';
  return out;
}

void compareLeg(const std::string& place, const Leg& read, const Leg& written, Mismatches& mismatches) {
  mismatches.text(place + ".kind", rowOf(read.kind).name, rowOf(written.kind).name);
  mismatches.text(place + ".actuated", motorsOf(read), motorsOf(written));
  mismatches.numbers(place + ".base_point", read.base_point, written.base_point);
  mismatches.numbers(place + ".base_axis", read.base_axis, written.base_axis);
  mismatches.numbers(place + ".platform_point", read.platform_point, written.platform_point);
  compareLink(place + ".proximal", read.proximal, written.proximal, mismatches);
  compareLink(place + ".distal", read.distal, written.distal, mismatches);
  const auto name = [](Knee knee) { return knee == Knee::positive ? "positive" : "negative"; };
  mismatches.text(place + ".knee", name(read.knee), name(written.knee));
  compareFriction(place + ".friction", read.friction, written.friction, mismatches);
  compareFriction(place + ".coulomb", read.coulomb, written.coulomb, mismatches);
  compareFriction(place + ".rotor_inertia", read.rotor_inertia, written.rotor_inertia, mismatches);
  mismatches.text(place + ".spin", read.spins ? "free" : "held", written.spins ? "free" : "held");
  mismatches.number(place + ".coulomb.smoothing_speed", read.coulomb.smoothing_speed, written.coulomb.smoothing_speed);
  mismatches.number(place + ".coulomb.smoothing_speed", read.coulomb.sliding_speed, written.coulomb.sliding_speed);
}

void compareMachine(const ManipulatorParameters& read, const ManipulatorParameters& written, Mismatches& mismatches) {
  mismatches.numbers("manipulator.gravity", read.gravity, written.gravity);
  mismatches.number("manipulator.platform.mass", read.platform.mass, written.platform.mass);
  mismatches.numbers("manipulator.platform.center_of_mass", read.platform.center_of_mass,
                     written.platform.center_of_mass);
  mismatches.numbers("manipulator.platform.inertia", read.platform.inertia.reshaped(),
                     written.platform.inertia.reshaped());
  mismatches.number("manipulator.leg: their number", static_cast<double>(read.legs.size()),
                    static_cast<double>(written.legs.size()));
  for (std::size_t i = 0; i < std::min(read.legs.size(), written.legs.size()); ++i)
    compareLeg(fmt::format("manipulator.leg[{}]", i + 1), read.legs[i], written.legs[i], mismatches);
}

/// At its rows a history has their values to the last bit, which shows what was read.
void compareRows(const LoadHistory& read, const std::vector<TimedWrench>& written, Mismatches& mismatches) {
  const std::vector<double>& times = read.knots();
  mismatches.number("load: the number of rows", static_cast<double>(times.size()), static_cast<double>(written.size()));
  for (std::size_t i = 0; i < std::min(times.size(), written.size()); ++i) {
    const std::string place = fmt::format("load.table[{}]", i + 1);
    const Wrench<double> wrench = read.at(times[i]);
    mismatches.number(place + ".time", times[i], written[i].time);
    // Sums may lose the sign of a zero.
    const Vector3d zero = Vector3d::Zero();
    mismatches.numbers(place + ".force", wrench.force + zero, written[i].wrench.force + zero);
    mismatches.numbers(place + ".moment", wrench.moment + zero, written[i].wrench.moment + zero);
  }
}

void compareLoad(const Load* read, const std::optional<LoadAsWritten>& written, Mismatches& mismatches) {
  mismatches.text("load", read == nullptr ? "none" : "given", written ? "given" : "none");
  if (read == nullptr || !written) return;
  mismatches.numbers("load.point", read->point, written->point);
  mismatches.text("load.frame", read->frame == Load::Frame::base ? "base" : "platform", written->frame);
  mismatches.text("load: its kind", read->history ? "tabulated" : "constant",
                  written->tabulated ? "tabulated" : "constant");
  if (read->history && written->tabulated) compareRows(*read->history, written->rows, mismatches);
  if (read->history || written->tabulated) return;
  mismatches.numbers("load.force", read->force, written->force);
  mismatches.numbers("load.moment", read->moment, written->moment);
}

}  // namespace

Mismatches mismatchesOf(const Scenario& scenario) {
  const FileAsWritten written = asWritten(scenario);
  Mismatches mismatches;
  compareMachine(scenario.manipulator->parameters(), written.machine, mismatches);
  compareTrajectory(*scenario.trajectory, written.trajectory, mismatches);
  compareLoad(scenario.load.get(), written.load, mismatches);
  return mismatches;
}

}  // namespace ursula
