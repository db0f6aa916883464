"""The sources of the toys of toys.py: new files, and lines inserted before a line of an existing file."""

from dataclasses import dataclass, field
from pathlib import Path

STARTING_UPS = Path(__file__).resolve().parent.parent / "apps/starting/UPS.toml"


@dataclass
class Toy:
    new: dict = field(default_factory=dict)    # file: text
    edits: dict = field(default_factory=dict)  # file: [(an existing line, what is inserted before it)]


CHECK = Toy(
    new={"validation/checks/toy_check.cpp": """#include "validation/checks/judges.h"

namespace ursula {

Check judgeToy(const Scenario& scenario) {
  Check check;
  check.name = "motion.toy";
  check.unit = "s";
  check.value = -scenario.trajectory->duration();
  check.limit = 0;
  check.basis = "a duration is positive";
  check.verdict = check.value <= check.limit ? Verdict::pass : Verdict::fail;
  return check;
}

}  // namespace ursula
"""},
    edits={
        "validation/checks/CMakeLists.txt": [("    torque_between.cpp\n", "    toy_check.cpp\n")],
        "validation/checks/judges.h": [("/// `torque.against_noc`: external", "Check judgeToy(const Scenario& scenario);\n\n")],
        "model/check_rows.cpp": [('      {"motion.load"', """\
      {"motion.toy", "s", N::nothing, G::input, nullptr, "Toy", "The motion takes some time.", "",
       LimitFrom::exact, "A duration is positive.", "Give the motion a duration."},
""")],
        "validation/checks/families.cpp": [('      {"between samples"', """\
      {"toy", {"motion.toy"}, always, [](E e) { return std::vector<Check>{judgeToy(*e.given)}; }, nullptr, true},
""")]})

TRAJECTORY = Toy(
    new={"model/trajectories/toy.cpp": """#include "base/real50.h"
#include "model/exact_trajectory.h"
#include "model/scenario_keys.h"
#include "model/trajectories/trajectory_kinds.h"

namespace ursula {

/// Stays at a position, upright.
template <class S>
class ToyKernel {
 public:
  explicit ToyKernel(const Vector3d& position) : position_(position) {}

  Motion<S> at(const S& t) const {
    Motion<S> motion;
    motion.t = t;
    motion.p = position_.cast<S>();
    motion.Q.setIdentity();
    return motion;
  }

 private:
  Vector3d position_;
};

namespace {

std::unique_ptr<Trajectory> makeToy(const Vector3d& position, double duration) {
  return std::make_unique<KernelTrajectory<ToyKernel>>(
      "toy", duration, ToyKernel<double>(position), ToyKernel<Real50>(position),
      [=](const Vector3d& origin) { return makeToy(position - origin, duration); });
}

}  // namespace

std::vector<ScenarioTable> toyKeys() {
  return {{"trajectory.toy",
           "[trajectory], kind = \\"toy\\"",
           "Stays where it is, upright.",
           {kindKey(), positionKey(), {"duration", KeyType::number, "s", required_key, "", above_zero}}}};
}

std::shared_ptr<const Trajectory> readToy(const TomlSection& table) {
  const ScenarioTable& keys = scenarioTable("trajectory.toy");
  table.allowOnly(keys);
  Vector3d position;
  double duration = 0;
  table.require("position", position);
  table.require("duration", duration);
  table.requireBound(keys.key("duration"), duration);
  return makeToy(position, duration);
}

}  // namespace ursula
"""},
    edits={
        "model/CMakeLists.txt": [("  trajectories/trajectory_kinds.cpp\n", "  trajectories/toy.cpp\n")],
        "model/trajectories/trajectory_kinds.h": [
            ("/// All kinds. A new kind", "std::vector<ScenarioTable> toyKeys();\n"
             "std::shared_ptr<const Trajectory> readToy(const TomlSection& table);\n\n"),
            ('    TrajectoryKind{"hold"', '    TrajectoryKind{"toy", "the toy", nullptr, toyKeys, readToy},\n')]})

ENGINE = Toy(
    new={"parts/engines/toy/toy_calls.cpp": """#include "parts/engines/leg_motion.h"
#include "parts/engines/loop_engine.h"

namespace ursula {
namespace {

/// Trees without mass: their loops close, and no effort moves them.
class ToyCalls : public LoopEngine {
 public:
  explicit ToyCalls(const Manipulator& manipulator) : LoopEngine(manipulator) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    for (int i = 0; i < manipulator().legCount(); ++i) {
      const Leg& leg = manipulator().leg(i);
      const LegMotion state = legState(chainOf(leg), leg, i, motion, bias == Bias::kept);
      const Vector3d arm = motion.Q * leg.platform_point;
      OpenTree::Leg& out = tree_.legs[static_cast<std::size_t>(i)];
      out.J = state.at.J;
      out.P << 0, arm.z(), -arm.y(), 1, 0, 0, -arm.z(), 0, arm.x(), 0, 1, 0, arm.y(), -arm.x(), 0, 0, 0, 1;
    }
    return tree_;
  }

 private:
  PlacedTree tree_;
};

}  // namespace

std::unique_ptr<LoopEngine> makeToyCalls(const Manipulator& manipulator, std::shared_ptr<const Load> /*load*/) {
  return std::make_unique<ToyCalls>(manipulator);
}

}  // namespace ursula
"""},
    edits={
        "parts/engines/CMakeLists.txt": [("# The engines that vote in a verdict", "set(toy toy/toy_calls.cpp)\n\n"),
                                         ("  LINKS ursula::model ursula::closing", "    ${toy}\n")],
        "parts/engines/loop_engine.h": [("/// DART is a module", "MakeLoopEngine makeToyCalls;\n\n")],
        "parts/engines/loop_engines.cpp": [('      {"MuJoCo", "libmujoco-dev"', """\
      {"Toy", "", alwaysAvailable, [] { return std::string(); }, makeToyCalls, Recipe::open, "weigh the bodies",
       "trees without mass", false},
""")]})


# Another name for UPS, so that it needs no mechanics of its own.
LEG_KIND = Toy(
    new={
        "model/legs/toy.cpp": """#include "model/legs/leg_type.h"

namespace ursula {

const LegType& toyLeg() { return upsLeg(); }

}  // namespace ursula
""",
        "nocsolver/legs/toy.h": """#pragma once

#include "nocsolver/legs/ups.h"

namespace ursula::legs {

constexpr Ups classOf(std::integral_constant<LegKind, LegKind::TOY>) { return {}; }

}  // namespace ursula::legs
""",
        "parts/fast/kernels/toy_kernel.h": """#pragma once

#include "parts/fast/kernels/ups_kernel.h"

namespace ursula::kernel {

using Toy = std::integral_constant<LegKind, LegKind::TOY>;

constexpr std::array<int, 3> rowOfMap(Toy) { return rowOfMap(Ups()); }

template <class S, class Guard>
void place(Toy, const PlaneModel<S>& leg, const Vector3<S>& k, Guard& guard, PlaneLeg<S>& out) {
  place(Ups(), leg, k, guard, out);
}

template <class S>
void setRates(Toy, const PlaneModel<S>& model, const Vector3<S>& h, const Vector3<S>& a, PlaneLeg<S>& leg) {
  setRates(Ups(), model, h, a, leg);
}

template <bool principal, class S>
Vector3<S> linkForces(Toy, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  return linkForces<principal, S>(Ups(), model, base, leg);
}

template <class S>
OffLinks<S> offLinks(Toy, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  return offLinks<S>(Ups(), model, base, leg);
}

template <class S>
Matrix3<S> massMatrix(Toy, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  return massMatrix<S>(Ups(), model, leg);
}

}  // namespace ursula::kernel
""",
        "apps/starting/TOY.toml": STARTING_UPS.read_text(encoding="utf-8").replace('"UPS"', '"TOY"')},
    edits={
        "model/leg_kind.h": [
            (" };\n\n/// The coordinates of a leg's joints", ", TOY"),
            (";\n\n/// The properties of a kind of leg", ", toyLeg"),
            ("};\nconstexpr std::size_t leg_kind_count", """\
    LegKindRow{"TOY", "a toy", "universal joint, cylinder and rod, ball",
               {Coordinate::phi, Coordinate::psi, Coordinate::d}, 2, 2, nullptr, toyLeg},
"""),
            ("    case LegKind::RUS:", "    case LegKind::TOY:\n      return f(std::integral_constant<LegKind, LegKind::TOY>());\n")],
        "model/CMakeLists.txt": [(")  # as in leg_kind.h", " TOY")],
        "nocsolver/legs/leg_of.h": [('#include "nocsolver/legs/ups.h"', '#include "nocsolver/legs/toy.h"\n')],
        "parts/fast/kernels/leg_kernels.h": [('#include "parts/fast/kernels/ups_kernel.h"',
                                                  '#include "parts/fast/kernels/toy_kernel.h"\n')]})

VERB = Toy(
    new={"parts/compare/toy_verb.cpp": """#include "apps/verbs.h"

namespace ursula {

void addToy(CLI::App& app, std::function<int()>& run) {
  CLI::App* verb = app.add_subcommand("toy", "Says what it is");
  verb->callback([&run] {
    run = [] {
      writeOutput("-", "a toy\\n");
      return exit_passed;
    };
  });
}

}  // namespace ursula
"""},
    edits={"parts/CMakeLists.txt": [("compare)", "toy ")]})

KEY = Toy(
    edits={
        "model/scenario.h": [("  Integrator integrator = Integrator::rkf78;", "  double toy = 1;  ///< s, above 0\n")],
        "model/scenario.cpp": [("  if (const auto integrator = table.readChoice",
                                '  table.read("toy", settings.toy);\n  table.requireBound(keys.key("toy"), settings.toy);\n')],
        "model/scenario_keys.cpp": [('           choiceKey("integrator",', '           {"toy", KeyType::number, "s", "1", "a toy", above_zero},\n')]})

TOYS = {"check": CHECK, "trajectory": TRAJECTORY, "engine": ENGINE, "kind of leg": LEG_KIND, "verb": VERB, "key": KEY}
