// Changes of frame: there and back gives the same numbers, torques do not change, and a change that omits any part is
// seen.

#include "validation/subject/frame_change.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "base/real50.h"
#include "parts/fast/solver.h"
#include "tests/support/motions.h"
#include "tests/validation/scenario_files.h"
#include "tests/validation/transformed_numbers.h"
#include "validation/limits/conditioning.h"
#include "validation/limits/engine_view.h"
#include "validation/limits/solver_rounding.h"

namespace ursula {
namespace {

/// There and back takes some ten products of three terms each, and positions lose digits by the origin's distance.
constexpr double room = 1e-14;

/// A machine with everything: full tensors, both laws of friction, no two legs alike.
const Scenario& everything() {
  static const Scenario scenario = scenarioOf("proving-ground");
  return scenario;
}

std::shared_ptr<const Load> tabulatedLoad(Load::Frame frame) {
  auto load = std::make_shared<Load>();
  load->point = {0.1, -0.2, 0.3};
  load->frame = frame;
  load->history = std::make_shared<const LoadHistory>(std::vector<TimedWrench>{{0, {{250, -180, -400}, {60, 90, -40}}},
                                                                               {1.5, {{-50, 80, -300}, {-20, 10, 70}}},
                                                                               {3, {{20, 30, 40}, {5, 6, 7}}}});
  return load;
}

class Transformed : public testing::TestWithParam<unsigned> {
 protected:
  Transformed() : there_(randomFrameChange(GetParam(), 1.5, *everything().manipulator)), back_(inverse(there_)) {
    // Control: the same change but for a turn by a billionth.
    off_ = there_;
    off_.turn = (Eigen::AngleAxisd(1e-9, Vector3d(0.6, 0, 0.8)) * off_.turn).eval();
    off_.platform_turn = (Eigen::AngleAxisd(1e-9, Vector3d(0.6, 0, 0.8)) * off_.platform_turn).eval();
  }

  FrameChange there_, back_, off_;
  SeededDraws dice_{GetParam() + 7};
  const Manipulator& machine_ = *everything().manipulator;
};

TEST_P(Transformed, machineMotionTorquesAndLoadComeBack) {
  EXPECT_LE(numbersOf(back_.transformed(there_.transformed(machine_))).distance(numbersOf(machine_)), room);
  EXPECT_GT(numbersOf(back_.transformed(off_.transformed(machine_))).distance(numbersOf(machine_)), 1e-10);
  const Motion<double> motion = randomState(everything(), dice_);
  EXPECT_LE(numbersOf(back_.transformed(there_.transformed(motion))).distance(numbersOf(motion)), room);
  EXPECT_GT(numbersOf(back_.transformed(off_.transformed(motion))).distance(numbersOf(motion)), 1e-10);
  const Vector6d torques = 1000 * Vector6d::Random();
  EXPECT_LE(numbersOf(there_.torquesBack(there_.transformed(torques))).distance(numbersOf(torques)), room);
  EXPECT_GT(numbersOf(back_.torquesBack(there_.transformed(torques))).distance(numbersOf(torques)), 0.01);
  for (const Load::Frame frame : {Load::Frame::base, Load::Frame::platform}) {
    const auto load = tabulatedLoad(frame);
    EXPECT_LE(numbersOf(*back_.transformed(there_.transformed(load))).distance(numbersOf(*load)), room);
    EXPECT_GT(numbersOf(*back_.transformed(off_.transformed(load))).distance(numbersOf(*load)), 1e-10);
  }
  EXPECT_EQ(there_.transformed(std::shared_ptr<const Load>()), nullptr);
}

/// A table's slopes are limited along its own axes, so the curve must be turned. Turned rows would give another curve
/// between them.
TEST_P(Transformed, aTabulatedLoadIsTheSameBetweenItsRows) {
  const auto load = tabulatedLoad(Load::Frame::base);
  const Units& units = there_.units;
  const auto there = there_.transformed(load);
  const LoadHistory through_rows(there->history->rows());
  double beside = 0;
  for (double t : {-0.5, 0.2, 0.75, 1.5, 1.9, 2.6, 3.5}) {
    const Wrench<double> here = load->at(t), found = there->at(t / units.time);
    const Wrench<Real50> exact = there->at(Real50(t) / Real50(units.time));
    const Vector3d force = there_.turn * here.force / units.force(),
                   moment = there_.turn * here.moment / units.torque();
    EXPECT_LE((found.force - force).norm(), room * force.norm() * 10) << t;
    EXPECT_LE((found.moment - moment).norm(), room * moment.norm() * 10) << t;
    EXPECT_LE((exact.force.cast<double>() - found.force).norm(), room * force.norm() * 10) << t;
    beside = std::max(beside, (through_rows.at(t / units.time).force - force).norm() / force.norm());
  }
  EXPECT_GT(beside, 1e-3) << "the rows alone would do";
}

TEST_P(Transformed, answersComeBack) {
  const Motion<double> motion = randomState(everything(), dice_);
  const Subject solver = solverOf(everything());
  const KinematicAnswer answer = solver.kinematics(motion);
  EXPECT_LE(numbersOf(there_.back(back_.back(answer.bodies))).distance(numbersOf(answer.bodies)), room);
  EXPECT_GT(numbersOf(off_.back(back_.back(answer.bodies))).distance(numbersOf(answer.bodies)), 1e-10);
  EXPECT_LE(numbersOf(there_.back(back_.back(answer.joints))).distance(numbersOf(answer.joints)), room);
  EXPECT_GT(numbersOf(there_.back(there_.back(answer.joints))).distance(numbersOf(answer.joints)), 0.01);
  const Reactions reactions = solver.reactions(motion);
  EXPECT_LE(numbersOf(there_.back(back_.back(reactions))).distance(numbersOf(reactions)), room);
  EXPECT_GT(numbersOf(off_.back(back_.back(reactions))).distance(numbersOf(reactions)), 1e-10);
}

/// The solver's torques for the machine in the other frame, converted back, N·m.
Vector6d torquesFrom(const FrameChange& there, const Manipulator& machine, const std::shared_ptr<const Load>& load,
                     const Motion<double>& motion) {
  return there.torquesBack(nocSubject(machine, load).torques(motion));
}

TEST_P(Transformed, torquesAreTheSame) {
  for (const Load::Frame frame : {Load::Frame::base, Load::Frame::platform})
    for (int k = 0; k < 5; ++k) {
      const auto load = tabulatedLoad(frame);
      const Motion<double> motion = randomState(everything(), dice_);
      const double limit = 2 * ConditioningProbe(machine_, load).at(motion).torqueRounding();
      const Vector6d right = nocSubject(machine_, load).torques(motion);
      EXPECT_LT(limit, 1e-8 * right.cwiseAbs().maxCoeff()) << "the limit says little";
      const Vector6d found =
          torquesFrom(there_, there_.transformed(machine_), there_.transformed(load), there_.transformed(motion));
      EXPECT_LE((found - right).cwiseAbs().maxCoeff(), limit);
      EXPECT_NE(found, right) << "nothing was turned";
    }
}

/// Each omission leaves one quantity unchanged while all others change their frame.
const std::vector<std::pair<const char*, std::function<void(const FrameChange&, const ManipulatorParameters& here,
                                                            ManipulatorParameters& there)>>>
    forgotten = {
        {"gravity turned alone",
         [](const auto& p, const auto& here, auto& there) {
           there.gravity = p.turn * p.turn * here.gravity / p.units.acceleration();
         }},
        {"gravity not turned",
         [](const auto& p, const auto& here, auto& there) { there.gravity = here.gravity / p.units.acceleration(); }},
        {"the platform's mass centre not turned",
         [](const auto& p, const auto& here, auto& there) {
           there.platform.center_of_mass = here.platform.center_of_mass / p.units.length;
         }},
        {"the platform's tensor not turned",
         [](const auto& p, const auto& here, auto& there) {
           there.platform.inertia = here.platform.inertia / (p.units.mass * p.units.length * p.units.length);
         }},
        {"a platform point turned a hundredth too little",
         [](const auto& p, const auto& here, auto& there) {
           Vector3d& point = there.legs[1].platform_point;
           point += (here.legs[static_cast<std::size_t>(p.leg[1])].platform_point / p.units.length - point) / 100;
         }},
        {"a leg's label",
         [](const auto&, const auto&, auto& there) {
           std::swap(there.legs[1].proximal.inertia, there.legs[2].proximal.inertia);
         }},
        {"a base point not shifted",
         [](const auto& p, const auto&, auto& there) { there.legs[3].base_point += p.turn * p.origin / 100; }},
        {"a base axis not turned",
         [](const auto& p, const auto& here, auto& there) {
           there.legs[0].base_axis = here.legs[static_cast<std::size_t>(p.leg[0])].base_axis;
         }},
        {"a link's mass in kilograms",
         [](const auto& p, const auto&, auto& there) { there.legs[4].distal.mass *= p.units.mass; }},
        {"a link's mass centre in metres",
         [](const auto& p, const auto&, auto& there) { there.legs[4].proximal.center_of_mass *= p.units.length; }},
        {"viscous friction in N m s",
         [](const auto& p, const auto&, auto& there) { there.legs[5].friction.phi *= p.units.torque(); }},
        {"Coulomb's in N m",
         [](const auto& p, const auto&, auto& there) { there.legs[5].coulomb.theta *= p.units.torque(); }},
        {"its smoothing speed in rad/s",
         [](const auto& p, const auto&, auto& there) { there.legs[5].coulomb.smoothing_speed *= p.units.time; }},
};

TEST_P(Transformed, aFrameChangeThatForgetsOnePartChangesTorques) {
  const auto load = tabulatedLoad(Load::Frame::base);
  const Motion<double> motion = randomState(everything(), dice_);
  const double limit = 2 * ConditioningProbe(machine_, load).at(motion).torqueRounding();
  const Vector6d right = nocSubject(machine_, load).torques(motion);
  for (const auto& [what, forget] : forgotten) {
    ManipulatorParameters wrong = there_.transformed(machine_).parameters();
    forget(there_, machine_.parameters(), wrong);
    const Vector6d found =
        torquesFrom(there_, Manipulator(wrong), there_.transformed(load), there_.transformed(motion));
    EXPECT_GT((found - right).cwiseAbs().maxCoeff(), 1000 * limit) << what;
  }
  Load not_turned = *there_.transformed(load);
  not_turned.frame = Load::Frame::platform;
  const Vector6d found =
      torquesFrom(there_, there_.transformed(machine_), std::make_shared<Load>(not_turned), there_.transformed(motion));
  EXPECT_GT((found - right).cwiseAbs().maxCoeff(), 1000 * limit) << "a load in the wrong frame";
}

TEST_P(Transformed, trajectoriesAreTheMotionsTransformed) {
  const Scenario& here = everything();
  const Scenario there = there_.transformed(here);
  const double time = there_.units.time, duration = here.trajectory->duration();
  EXPECT_DOUBLE_EQ(there.trajectory->duration() * time, duration);
  ASSERT_EQ(there.trajectory->knots().size(), here.trajectory->knots().size());
  for (std::size_t k = 0; k < here.trajectory->knots().size(); ++k)
    EXPECT_DOUBLE_EQ(there.trajectory->knots()[k] * time, here.trajectory->knots()[k]);
  for (double share : {0.1, 0.45, 0.9}) {
    const Motion<double> found = there.trajectory->at(share * duration / time);
    EXPECT_EQ(found.t, share * duration / time);
    EXPECT_LE(numbersOf(back_.transformed(found)).distance(numbersOf(here.trajectory->at(share * duration))),
              10 * room);
    const Motion<Real50> exact = there.trajectory->at(Real50(share * duration / time));
    EXPECT_LE((exact.p.cast<double>() - found.p).norm(), room);
    EXPECT_LE((exact.Q.cast<double>() - found.Q).norm(), room);
    EXPECT_LE((exact.omega_dot.cast<double>() - found.omega_dot).norm(), 10 * room * (1 + found.omega_dot.norm()));
    EXPECT_LE((exact.p_ddot.cast<double>() - found.p_ddot).norm(), 10 * room * (1 + found.p_ddot.norm()));
  }
}

/// The subject is made in one frame and asked in another, with other units only, as in validate().
TEST_P(Transformed, subjectsAnswerFromThere) {
  FrameChange there;
  there.origin = there_.origin;
  there.units = there_.units;
  const Subject here = solverOf(everything()), asked = transformed(here, there);
  const Subject made = nocSubject(there.transformed(machine_), there.transformed(everything().load));
  const Motion<double> motion = there.transformed(randomState(everything(), dice_));
  const auto near = [](const Numbers& a, const Numbers& b) { return a.distance(b); };
  EXPECT_LE(near(numbersOf(asked.torques(motion)), numbersOf(made.torques(motion))), 1e-11);
  const KinematicAnswer a = asked.kinematics(motion), b = made.kinematics(motion);
  EXPECT_LE(near(numbersOf(a.joints), numbersOf(b.joints)), 1e-11);
  EXPECT_LE(near(numbersOf(a.bodies), numbersOf(b.bodies)), 1e-11);
  EXPECT_LE((a.T - b.T).norm() / b.T.norm(), 1e-11);
  EXPECT_LE((a.T_rate - b.T_rate).norm() / b.T_rate.norm(), 1e-11);
  const Vector6d torques = 1.1 * made.torques(motion);
  const Vector6d under = made.accelerations(motion, torques);
  EXPECT_LE((asked.accelerations(motion, torques) - under).norm() / under.norm(), 1e-10);
  const Manipulator lighter = [&] {
    ManipulatorParameters parameters = there.transformed(machine_).parameters();
    parameters.platform.mass *= 0.9;
    return Manipulator(parameters);
  }();
  EXPECT_LE(near(numbersOf(asked.rebuilt(lighter).torques(motion)), numbersOf(made.rebuilt(lighter).torques(motion))),
            1e-11);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Transformed, testing::Range(1001u, 1006u));

/// Compares all engines' answers in two frames; a mistaken leg would exceed rounding.
TEST(EngineFrameChanges, seeTheSame) {
  const Scenario& scenario = everything();
  const Motion<double> motion = scenario.trajectory->at(1.3);
  const Vector6d torques = solverOf(scenario).torques(motion), others = 1.2 * torques;
  const EngineView a = EngineFrameChange(scenario, FrameChange{}).at(motion, torques, others);
  const EngineView b =
      EngineFrameChange(scenario, randomFrameChange(1001, 1.5, *scenario.manipulator)).at(motion, torques, others);
  const auto near = [](const auto& x, const auto& y) { return numbersOf(x).distance(numbersOf(y)); };
  EXPECT_LE(near(a.bodies, b.bodies), 1e-10);
  EXPECT_LE(near(a.reactions, b.reactions), 1e-9);
  for (Vector6d EngineView::*v : {&EngineView::torques, &EngineView::acceleration, &EngineView::direct})
    EXPECT_LE((a.*v - b.*v).norm(), 1e-10 * (a.*v).norm());
  for (std::size_t k = 0; k < furtherEngines().size(); ++k) {
    const std::optional<Vector6d>&of_a = a.further[k], &of_b = b.further[k];
    ASSERT_EQ(of_a.has_value(), furtherEngines()[k].available());
    ASSERT_EQ(of_b.has_value(), of_a.has_value());
    if (of_a) {
      EXPECT_LE((*of_a - *of_b).norm(), 1e-10 * torques.norm()) << furtherEngines()[k].name;
    }
  }
  EXPECT_GT((a.direct - a.acceleration).norm(), 0.1) << "other torques are to move it otherwise";
}

/// The solver's rounding is measured in one frame; its evaluations differ by rounding and by no more.
TEST(SolverRounding, isThatOfDoublesAndNotZero) {
  const Scenario& scenario = everything();
  const Motion<double> motion = scenario.trajectory->at(1.3);
  const Vector6d torques = solverOf(scenario).torques(motion);
  SolverRounding rounding(*scenario.manipulator, scenario.load);
  const std::vector<SolverView> views = rounding.at(motion, 1.2 * torques);
  ASSERT_GT(views.size(), 2u);
  EXPECT_EQ(views.front().torques, torques);
  for (std::size_t k = 1; k < views.size(); ++k) {
    EXPECT_GT((views[k].torques - torques).norm(), 0) << k;
    EXPECT_LE((views[k].torques - torques).norm(), 1e-11 * torques.norm()) << k;
    EXPECT_LE((views[k].T - views.front().T).norm(), 1e-11 * views.front().T.norm()) << k;
  }
}

TEST(UnitsOf, areThoseOfChecksAndColumns) {
  const Units units{2, 8, 0.5};
  const std::vector<std::pair<const char*, double>> sizes = {
      {"", 1},        {"1", 1},      {"rad", 1},  {"s", 0.5}, {"1/s", 2}, {"rad/s", 2}, {"rad_s", 2},
      {"rad/s^2", 4}, {"rad_s2", 4}, {"m", 2},    {"m/s", 4}, {"m_s", 4}, {"m/s^2", 8}, {"m_s2", 8},
      {"N", 64},      {"N m", 128},  {"Nm", 128}, {"J", 128}, {"kg", 8}};
  for (const auto& [unit, size] : sizes) EXPECT_EQ(units.sizeOf(unit), size) << unit;
  EXPECT_THROW(units.sizeOf("furlong"), std::invalid_argument);
}

}  // namespace
}  // namespace ursula
