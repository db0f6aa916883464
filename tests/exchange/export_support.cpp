#include "tests/exchange/export_support.h"

#include <fmt/format.h>

#include <algorithm>

#include "nocsolver/noc/noc.h"
#include "parts/exchange/write/export.h"

namespace ursula::exchange {

SeenBody together(const SeenBodies& bodies) {
  SeenBody out;
  for (const auto& [name, body] : bodies) {
    out.mass += body.mass;
    out.center_of_mass += body.mass * body.center_of_mass;
  }
  out.center_of_mass /= out.mass;
  for (const auto& [name, body] : bodies) {
    const Vector3d arm = body.center_of_mass - out.center_of_mass;
    out.inertia += body.inertia + body.mass * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
  }
  return out;
}

SeenBodies expectedBodies(const Scenario& scenario) {
  const Manipulator& machine = *scenario.manipulator;
  const Noc<double> noc(machine);
  NocWorkspace<double> work;
  const Motion<double> motion = scenario.trajectory->at(0);
  noc.inverseKinematics(motion, work);
  noc.bodyMotions(motion, work, work.bodies);
  SeenBodies out;
  const auto add = [&](const std::string& name, std::size_t at, double mass, const Matrix3d& inertia) {
    const BodyMotion<double>& body = work.bodies[at];
    out[name] = {mass, body.c, body.R * inertia * body.R.transpose()};
  };
  for (int i = 0; i < machine.legCount(); ++i) {
    const Leg& leg = machine.leg(i);
    const auto at = static_cast<std::size_t>(i);
    const Leg& given = machine.given().legs[at];
    add(fmt::format("leg_{}_proximal", i + 1), at, leg.proximal.mass, given.proximal.inertia);
    add(fmt::format("leg_{}_distal", i + 1), at + leg_count, leg.distal.mass, given.distal.inertia);
  }
  add("platform", 2 * leg_count, machine.platform().mass, machine.platform().inertia);
  return out;
}

namespace {

double deviation(const SeenBody& seen, const SeenBody& expected, double size) {
  return std::max({std::abs(seen.mass - expected.mass) / expected.mass,
                   (seen.center_of_mass - expected.center_of_mass).norm() / size,
                   (seen.inertia - expected.inertia).norm() / expected.inertia.norm()});
}

}  // namespace

double deviation(const SeenBodies& seen, const SeenBodies& expected) {
  const SeenBody all = together(expected);
  const double size = std::sqrt(all.inertia.trace() / all.mass);
  if (seen.size() != expected.size()) return 1;
  double worst = deviation(together(seen), all, size);
  for (const auto& [name, body] : expected) {
    const auto found = seen.find(name);
    if (found == seen.end()) return 1;
    worst = std::max(worst, deviation(found->second, body, size));
  }
  return worst;
}

const std::vector<std::string>& machines() {
  static const std::vector<std::string> all = {
      "apps/starting/URS.toml",          "apps/starting/UPS.toml",          "apps/starting/RUS.toml",
      "apps/starting/PUS.toml",          "scenarios/full-tensors.toml",     "scenarios/mixture.toml",
      "scenarios/three-legs.toml",       "scenarios/knees-mixed.toml",      "scenarios/axis-along-z.toml",
      "scenarios/gravity-sideways.toml", "scenarios/viscous-friction.toml", "scenarios/free-rods.toml"};
  return all;
}

bool isInBall(const Leg& leg, Coordinate coordinate) {
  const LegKindRow& row = rowOf(leg.kind);
  const bool in_universal =
      row.joints_of_proximal == 2 ? coordinate != row.coordinates[2] : coordinate != row.coordinates[0];
  return leg.spins && in_universal;
}

int axesOf(const Scenario& scenario) {
  int out = 0;
  for (int i = 0; i < scenario.manipulator->legCount(); ++i)
    for (const Coordinate each : rowOf(scenario.manipulator->leg(i).kind).coordinates)
      if (!isInBall(scenario.manipulator->leg(i), each)) ++out;
  return out;
}

Scenario machine(const std::string& name) { return readScenario(std::string(URSULA_SOURCE) + "/" + name); }

std::string textOf(const Scenario& scenario, ModelFormat format) { return exportScenario(scenario, format).text; }

MachineModel withTensorNotTurned(const Scenario& scenario) {
  MachineModel out = modelOf(scenario);
  for (std::size_t body = 0; body < out.own.size(); ++body)
    if (out.graph.bodies[body].name == "leg_2_distal") out.own[body].inertia = out.graph.bodies[body].inertia;
  return out;
}

}  // namespace ursula::exchange
