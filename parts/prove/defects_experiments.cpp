// This file has defects in the experiments themselves: an engine, reactions, an integrator, the energy balance. Their
// numbers are in natural units, with lengths of the machine's size and masses of the machine's.

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "parts/prove/defects.h"
#include "parts/prove/prove.h"
#include "validation/limits/further_engines.h"

namespace ursula {
namespace {

/// Gives the indices in SimbodyLoop's state x = [q, u], to which the replay adds the work. The state has three
/// coordinates per leg, the platform's quaternion and position. Their rates, its angular velocity and its velocity
/// follow.
class Places {
 public:
  explicit Places(const Manipulator& machine) : legs_(3 * machine.parameters().legs.size()) {}
  std::size_t quaternion() const { return legs_; }
  std::size_t position() const { return legs_ + 4; }
  std::size_t rates() const { return legs_ + 7; }
  std::size_t velocity() const { return rates() + legs_ + 3; }
  static std::size_t joint(std::size_t leg, std::size_t k) { return 3 * leg + k; }

 private:
  std::size_t legs_;
};

using State = std::vector<double>;
using FaultState = std::function<void(State&)>;

Defect faulty(const std::string& name, const InjectedFault& fault) {
  Defect out{name, "experiment"};
  out.fault = fault;
  out.formulations_wanted = 1;
  return out;
}

InjectedFault::ScenarioChange another(const ChangeMachine& change) {
  return [change](const Scenario& s) {
    Scenario wrong = s;
    wrong.manipulator = std::make_shared<const Manipulator>(changedMachine(*s.manipulator, change));
    return wrong;
  };
}

/// Falsifies the engine of the further formulation of `check`, or Simbody's loop at the samples for torque.pointwise.
/// It is wrong wherever it is asked, by its own numbers of legs and in its own frame.
Defect engine(const std::string& name, const std::string& check, const EngineFault& wrong) {
  InjectedFault fault;
  if (check == "torque.pointwise") fault.formulations.simbody = wrong;
  for (std::size_t k = 0; k < furtherEngines().size(); ++k)
    if (furtherEngines()[k].check == check) fault.formulations.further[k] = wrong;
  return faulty(name, fault);
}

/// Builds it from another machine.
Defect engine(const std::string& name, const std::string& check, const ChangeMachine& change) {
  return engine(name, check, EngineFault{change, nullptr});
}

Defect stabilised(const std::string& name, const ChangeMachine& change) {
  InjectedFault fault;
  fault.feedback = another(change);
  return faulty(name, fault);
}

Defect wrongSample(const char* name, const std::function<void(PointwiseSample&)>& change) {
  InjectedFault fault;
  fault.sample = change;
  return faulty(name, fault);
}

Defect wrongReactions(const std::string& name, const std::function<void(Reactions&)>& change) {
  InjectedFault fault;
  fault.reactions = change;
  return faulty(name, fault);
}

Defect wrongReplay(const std::string& name, const InjectedFault::Settings& settings) {
  InjectedFault fault;
  fault.replay = settings;
  return faulty(name, fault);
}

/// Changes the state after each step of the judged replay.
Defect eachStep(const std::string& name, FaultState change) {
  return wrongReplay(
      name, [change](ReplaySettings& settings) { settings.fault = [change](double, State& x) { change(x); }; });
}

/// Changes the state after each step and moves the legs back to the platform, which is a drift along the machine's
/// freedom.
Defect drift(const char* name, FaultState change) {
  return wrongReplay(name, [change](ReplaySettings& settings) {
    settings.fault = [change](double, State& x) { change(x); };
    settings.project = true;
  });
}

/// Changes the state after the last step only, so that nothing follows from it.
Defect lastStep(const std::string& name, FaultState change) {
  return wrongReplay(name, [change](ReplaySettings& settings) {
    settings.fault = [change, end = settings.end](double t, State& x) {
      if (t == end) change(x);
    };
  });
}

Defect wrongPower(const char* name, double (*more)(const SimbodyLoop::Power&)) {
  return wrongReplay(name, [more](ReplaySettings& settings) { settings.fault_power = more; });
}

Defect wrongLadder(const char* name, Integrator integrator, const InjectedFault::Settings& change) {
  InjectedFault fault;
  fault.ladder = [integrator, change](ReplaySettings& settings) {
    if (settings.integrator == integrator) change(settings);
  };
  return faulty(name, fault);
}

Defect lowerOrder() {
  InjectedFault fault;
  fault.lower_order = true;
  return faulty("an integrator of order 5 for one of order 8", fault);
}

/// Returns errors inside an engine that depend on leg, motor, axis or frame, so that they differ between its own
/// frames.
std::vector<Defect> unevenEngines(const Manipulator& machine) {
  using P = ManipulatorParameters;
  const std::size_t third = legOf(machine, 3), fifth = legOf(machine, 5);
  const Vector3d down = machine.gravity().stableNormalized();
  return {engine("Simbody: mass of one distal link off by 1e-9", "torque.pointwise",
                 [=](P& m) { m.legs[fifth].distal.mass *= 1 + 1e-9; }),
          engine("Simbody: effort of motor 5 off by 1e-9", "torque.pointwise",
                 {nullptr, [](Vector6d& efforts) { efforts(4) *= 1 + 1e-9; }}),
          engine("Simbody: gravity along z off by 1e-9", "torque.pointwise", [](P& m) { m.gravity.z() *= 1 + 1e-9; }),
          engine("Simbody's second loop: effort of motor 5 off by 1e-9", "torque.twin",
                 {nullptr, [](Vector6d& efforts) { efforts(4) *= 1 + 1e-9; }}),
          engine("maximal coordinates: mass centre of leg 3 off by 1e-9", "torque.maximal",
                 [=](P& m) { m.legs[third].distal.center_of_mass *= 1 + 1e-9; }),
          engine("maximal coordinates: gravity across the given one off by 1e-9", "torque.maximal",
                 [=](P& m) { m.gravity += 1e-9 * (m.gravity - m.gravity.dot(down) * down); }),
          engine("MuJoCo: gravity along z off by 1e-9", "torque.mujoco", [](P& m) { m.gravity.z() *= 1 + 1e-9; })};
}

std::vector<Defect> wrongEngines(const Manipulator& machine) {
  using P = ManipulatorParameters;
  const bool paper = machine.isOfThePaper();
  const std::size_t second = legOf(machine, 2), third = legOf(machine, 3), fourth = legOf(machine, 4),
                    fifth = legOf(machine, 5), sixth = legOf(machine, 6);
  const Coordinate last = coordinatesOf(machine, sixth)[2], first = coordinatesOf(machine, second)[0];
  return {engine("Simbody's second loop: a mass off by 1e-8", "torque.twin",
                 [](P& m) { m.legs[0].proximal.mass *= 1 + 1e-8; }),
          engine("Simbody's second loop: a platform point off by 1e-10 m", "torque.twin",
                 [=](P& m) { m.legs[fifth].platform_point.x() += 1e-10; }),
          engine("maximal coordinates: a tensor off by 1e-6", "torque.maximal",
                 [=](P& m) { m.legs[third].distal.inertia *= 1 + 1e-6; }),
          engine(paper ? "maximal coordinates: no Coulomb friction in one knee"
                       : "maximal coordinates: no Coulomb friction on one coordinate",
                 "torque.maximal", [=](P& m) { m.legs[sixth].coulomb.on(last) = 0; }),
          engine("MuJoCo: gravity off by 1e-9", "torque.mujoco", [](P& m) { m.gravity *= 1 + 1e-9; }),
          engine("MuJoCo: a link longer by 1e-9", "torque.mujoco",
                 [=](P& m) {
                   Leg& leg = m.legs[fourth];
                   // A cylinder's length is its stroke; a carriage's is only for drawing.
                   const bool matters = !rowOf(leg.kind).isTelescopic() && !rowOf(leg.kind).hasCarriage();
                   (matters ? leg.proximal : leg.distal).length *= 1 + 1e-9;
                 }),
          stabilised("stabilised replay: a mass off by 1e-7", [](P& m) { m.platform.mass *= 1 + 1e-7; }),
          stabilised("stabilised replay: friction of one motor off by 1e-5",
                     [=](P& m) { m.legs[second].friction.on(first) *= 1 + 1e-5; }),
          wrongSample("Simbody's acceleration of the platform off by 1e-8",
                      [](PointwiseSample& sample) { sample.acceleration.error += 1e-8; })};
}

std::vector<Defect> wrongReactionForces(const Manipulator& machine) {
  const bool paper = machine.isOfThePaper();
  const std::size_t second = legOf(machine, 2), fourth = legOf(machine, 4), fifth = legOf(machine, 5),
                    sixth = otherLeg(machine, 6, fifth);
  return {wrongReactions("reaction moments about a point 1e-8 off",
                         [](Reactions& reactions) {
                           for (LegReactions& leg : reactions) leg.n_A += 1e-8 * Vector3d::UnitX().cross(leg.f_A);
                         }),
          wrongReactions(fmt::format("sign of f_B, leg {}", fourth + 1),
                         [=](Reactions& reactions) { reactions[fourth].f_B *= -1; }),
          wrongReactions(
              fmt::format("reaction {} leg 2 off by 1e-9 of itself", paper ? "at the knee of" : "between the links of"),
              [=](Reactions& reactions) { reactions[second].f_R *= 1 + 1e-9; }),
          wrongReactions(fmt::format("reactions of legs {} and {} exchanged", fifth + 1, sixth + 1),
                         [=](Reactions& reactions) { std::swap(reactions[fifth], reactions[sixth]); })};
}

/// Returns defects in the energy balance, and in the replays to compare with. `v` is the index of the platform's
/// velocity.
std::vector<Defect> wrongAccounts(std::size_t v) {
  return {wrongPower("no power of friction in the energy's account",
                     [](const SimbodyLoop::Power& power) { return -power.friction; }),
          wrongPower("friction's power off by 1e-6 in the energy's account",
                     [](const SimbodyLoop::Power& power) { return 1e-6 * power.friction; }),
          wrongPower("no power of the load in the energy's account",
                     [](const SimbodyLoop::Power& power) { return -power.load; }),
          wrongPower("motors' power off by 1e-9 in the energy's account",
                     [](const SimbodyLoop::Power& power) { return 1e-9 * power.actuators; }),
          wrongLadder("coarser replays that heed no tolerance", Integrator::rkf78,
                      [](ReplaySettings& settings) { settings.tolerance = 1e-6; }),
          wrongLadder("coarser replays falsified by 1e-9 after each step", Integrator::rkf78,
                      [=](ReplaySettings& settings) { settings.fault = [=](double, State& x) { x[v] += 1e-9; }; }),
          wrongLadder("second integrator starts 1e-7 beside the path", Integrator::rk_merson,
                      [](ReplaySettings& settings) { settings.deviation(0) = 1e-7; })};
}

/// Changes the result of a step: with the legs moved back, with gaps, or after the last step.
std::vector<Defect> movedSteps(const Manipulator& machine) {
  const Places places(machine);
  const std::size_t p = places.position(), q = places.quaternion(), v = places.velocity(), rates = places.rates();
  const std::size_t second = legOf(machine, 2), third = legOf(machine, 3), fifth = legOf(machine, 5),
                    sixth = legOf(machine, 6);
  const auto named = [&](std::size_t leg, std::size_t k) { return nameOf(coordinatesOf(machine, leg)[k]); };
  const auto last = [&](std::size_t leg) { return machine.isOfThePaper() ? "knee" : named(leg, 2); };
  return {drift("platform moved by 1e-10 after each step", [=](State& x) { x[p] += 1e-10; }),
          drift("platform faster by 1e-10 after each step", [=](State& x) { x[v] += 1e-10; }),
          eachStep("platform moved by 1e-10 after each step, gaps left", [=](State& x) { x[p] += 1e-10; }),
          eachStep(fmt::format("{} of leg 2 off by 1e-10 after each step", named(second, 1)),
                   [=](State& x) { x[Places::joint(second, 1)] += 1e-10; }),
          eachStep(fmt::format("{}'s rate of leg {} off by 1e-10 after each step", last(fifth), fifth + 1),
                   [=](State& x) { x[rates + Places::joint(fifth, 2)] += 1e-10; }),
          lastStep("platform turned by 2e-8 at the end", [=](State& x) { x[q + 1] += 1e-8; }),
          lastStep(fmt::format("{} of leg 3 off by 1e-8 at the end", last(third)),
                   [=](State& x) { x[Places::joint(third, 2)] += 1e-8; }),
          lastStep(fmt::format("{}'s rate of leg {} off by 1e-8 at the end", last(sixth), sixth + 1),
                   [=](State& x) { x[rates + Places::joint(sixth, 2)] += 1e-8; })};
}

std::vector<Defect> wrongReplays(const Manipulator& machine) {
  std::vector<Defect> out = {lowerOrder(), wrongReplay("integrator that accepts a million times its tolerance",
                                                       [](ReplaySettings& settings) { settings.tolerance *= 1e6; })};
  append(out, movedSteps(machine));
  append(out, wrongAccounts(Places(machine).velocity()));
  return out;
}

std::vector<Defect> controls() {
  std::vector<Defect> out = {control(stabilised("stabilised replay: no fault", [](ManipulatorParameters&) {})),
                             control(wrongSample("sample: no fault", [](PointwiseSample&) {})),
                             control(wrongReactions("reactions: no fault", [](Reactions&) {})),
                             control(eachStep("step: no fault", [](State&) {})),
                             control(lastStep("last step: no fault", [](State&) {})),
                             control(wrongLadder("ladder: no fault", Integrator::rkf78, [](ReplaySettings&) {}))};
  for (const EngineKind& kind : furtherEngines())
    out.push_back(control(engine(engineOf(kind.check) + ": no fault", kind.check, [](ManipulatorParameters&) {})));
  return out;
}

}  // namespace

std::vector<Defect> experimentDefects(const Manipulator& machine) {
  std::vector<Defect> out = wrongEngines(machine);
  append(out, unevenEngines(machine));
  append(out, wrongReactionForces(machine));
  append(out, wrongReplays(machine));
  append(out, controls());
  return out;
}

}  // namespace ursula
