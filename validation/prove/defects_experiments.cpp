// The experiments themselves spoilt: a road's engine, reactions, an integrator, the energy's account. The numbers are
// those of natural units, in which lengths are of the machine's size and masses of the machine's.

#include <Eigen/Geometry>

#include "model/loops/further_roads.h"
#include "validation/prove/defects_kit.h"

namespace ursula {
namespace {

// Of SimbodyLoop's state x = [q, u], to which the replay adds the work.
constexpr std::size_t position_of_platform = 22;
constexpr std::size_t quaternion_of_platform = 18;
constexpr std::size_t velocity_of_platform = 46;
constexpr std::size_t coordinates = 25;
constexpr std::size_t psi(std::size_t leg) { return 3 * leg + 1; }
constexpr std::size_t theta(std::size_t leg) { return 3 * leg + 2; }

using State = std::vector<double>;
using SpoilState = void (*)(State&);

Defect spoilt(const std::string& name, const Spoil& spoil) {
  Defect out{name, "experiment"};
  out.spoil = spoil;
  out.roads = 1;
  return out;
}

Spoil::Seen another(const ChangeMachine& change) {
  return [change](const Scenario& s) {
    Scenario wrong = s;
    wrong.manipulator = std::make_shared<const Manipulator>(changedMachine(*s.manipulator, change));
    return wrong;
  };
}

/// The engine of the further road of `check`, built of another machine.
Defect engine(const char* name, const char* check, const ChangeMachine& change) {
  Spoil spoil;
  for (std::size_t k = 0; k < further_road_count; ++k)
    if (furtherRoads()[k].check == std::string(check)) spoil.further[k] = another(change);
  return spoilt(name, spoil);
}

Defect stabilised(const char* name, const ChangeMachine& change) {
  Spoil spoil;
  spoil.feedback = another(change);
  return spoilt(name, spoil);
}

Defect wrongSample(const char* name, const std::function<void(PointwiseSample&)>& change) {
  Spoil spoil;
  spoil.sample = change;
  return spoilt(name, spoil);
}

Defect wrongReactions(const char* name, const std::function<void(Reactions&)>& change) {
  Spoil spoil;
  spoil.reactions = change;
  return spoilt(name, spoil);
}

Defect wrongReplay(const char* name, const Spoil::Settings& settings) {
  Spoil spoil;
  spoil.replay = settings;
  return spoilt(name, spoil);
}

/// After each step of the judged replay.
Defect eachStep(const char* name, SpoilState change) {
  return wrongReplay(
      name, [change](ReplaySettings& settings) { settings.spoil = [change](double, State& x) { change(x); }; });
}

/// After each step, with the legs brought back to the platform: a drift along the machine's freedom.
Defect drift(const char* name, SpoilState change) {
  return wrongReplay(name, [change](ReplaySettings& settings) {
    settings.spoil = [change](double, State& x) { change(x); };
    settings.project = true;
  });
}

/// After the last step only, so that nothing comes of it.
Defect lastStep(const char* name, SpoilState change) {
  return wrongReplay(name, [change](ReplaySettings& settings) {
    settings.spoil = [change, end = settings.end](double t, State& x) {
      if (t == end) change(x);
    };
  });
}

Defect wrongPower(const char* name, double (*more)(const SimbodyLoop::Power&)) {
  return wrongReplay(name, [more](ReplaySettings& settings) { settings.spoil_power = more; });
}

Defect wrongLadder(const char* name, Integrator integrator, const Spoil::Settings& change) {
  Spoil spoil;
  spoil.ladder = [integrator, change](ReplaySettings& settings) {
    if (settings.integrator == integrator) change(settings);
  };
  return spoilt(name, spoil);
}

Defect lowerOrder() {
  Spoil spoil;
  spoil.lower_order = true;
  return spoilt("an integrator of order 5 for one of order 8", spoil);
}

std::vector<Defect> wrongEngines() {
  using P = ManipulatorParameters;
  return {engine("Simbody's second loop: a mass off by 1e-8", "torque.twin",
                 [](P& m) { m.legs[0].proximal.mass *= 1 + 1e-8; }),
          engine("Simbody's second loop: a platform point off by 1e-10 m", "torque.twin",
                 [](P& m) { m.legs[4].platform_point.x() += 1e-10; }),
          engine("maximal coordinates: a tensor off by 1e-6", "torque.maximal",
                 [](P& m) { m.legs[2].distal.inertia *= 1 + 1e-6; }),
          engine("maximal coordinates: no Coulomb friction in one knee", "torque.maximal",
                 [](P& m) { m.legs[5].coulomb.theta = 0; }),
          engine("MuJoCo: gravity off by 1e-9", "torque.mujoco", [](P& m) { m.gravity *= 1 + 1e-9; }),
          engine("MuJoCo: a link longer by 1e-9", "torque.mujoco", [](P& m) { m.legs[3].proximal.length *= 1 + 1e-9; }),
          stabilised("stabilised replay: a mass off by 1e-7", [](P& m) { m.platform.mass *= 1 + 1e-7; }),
          stabilised("stabilised replay: friction of one motor off by 1e-5",
                     [](P& m) { m.legs[1].friction.phi *= 1 + 1e-5; }),
          wrongSample("Simbody's acceleration of the platform off by 1e-8",
                      [](PointwiseSample& sample) { sample.acceleration.error += 1e-8; })};
}

std::vector<Defect> wrongReactionForces() {
  return {wrongReactions("reaction moments about a point 1e-8 off",
                         [](Reactions& reactions) {
                           for (LegReactions& leg : reactions) leg.n_A += 1e-8 * Vector3d::UnitX().cross(leg.f_A);
                         }),
          wrongReactions("sign of f_B, leg 4", [](Reactions& reactions) { reactions[3].f_B *= -1; }),
          wrongReactions("reaction at the knee of leg 2 off by 1e-9 of itself",
                         [](Reactions& reactions) { reactions[1].f_R *= 1 + 1e-9; }),
          wrongReactions("reactions of legs 5 and 6 exchanged",
                         [](Reactions& reactions) { std::swap(reactions[4], reactions[5]); })};
}

std::vector<Defect> wrongReplays() {
  return {lowerOrder(),
          wrongReplay("integrator that accepts a million times its tolerance",
                      [](ReplaySettings& settings) { settings.tolerance *= 1e6; }),
          drift("platform moved by 1e-10 after each step", [](State& x) { x[position_of_platform] += 1e-10; }),
          drift("platform faster by 1e-10 after each step", [](State& x) { x[velocity_of_platform] += 1e-10; }),
          eachStep("platform moved by 1e-10 after each step, gaps left",
                   [](State& x) { x[position_of_platform] += 1e-10; }),
          eachStep("psi of leg 2 off by 1e-10 after each step", [](State& x) { x[psi(1)] += 1e-10; }),
          eachStep("knee's rate of leg 5 off by 1e-10 after each step",
                   [](State& x) { x[coordinates + theta(4)] += 1e-10; }),
          lastStep("platform turned by 2e-8 at the end", [](State& x) { x[quaternion_of_platform + 1] += 1e-8; }),
          lastStep("knee of leg 3 off by 1e-8 at the end", [](State& x) { x[theta(2)] += 1e-8; }),
          lastStep("knee's rate of leg 6 off by 1e-8 at the end", [](State& x) { x[coordinates + theta(5)] += 1e-8; }),
          wrongPower("no power of friction in the energy's account",
                     [](const SimbodyLoop::Power& power) { return -power.friction; }),
          wrongPower("friction's power off by 1e-6 in the energy's account",
                     [](const SimbodyLoop::Power& power) { return 1e-6 * power.friction; }),
          wrongPower("no power of the load in the energy's account",
                     [](const SimbodyLoop::Power& power) { return -power.load; }),
          wrongPower("motors' power off by 1e-9 in the energy's account",
                     [](const SimbodyLoop::Power& power) { return 1e-9 * power.actuators; }),
          wrongLadder("coarser replays that heed no tolerance", Integrator::rkf78,
                      [](ReplaySettings& settings) { settings.tolerance = 1e-6; }),
          wrongLadder("coarser replays spoilt by 1e-9 after each step", Integrator::rkf78,
                      [](ReplaySettings& settings) {
                        settings.spoil = [](double, State& x) { x[velocity_of_platform] += 1e-9; };
                      }),
          wrongLadder("second integrator starts 1e-7 beside the path", Integrator::rk_merson,
                      [](ReplaySettings& settings) { settings.deviation(0) = 1e-7; })};
}

}  // namespace

std::vector<Defect> experimentDefects() {
  std::vector<Defect> out = wrongEngines();
  append(out, wrongReactionForces());
  append(out, wrongReplays());
  return out;
}

}  // namespace ursula
