// Every impossible machine is refused, and the machine one step inside each bound is accepted.

#include "model/manipulator.h"

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

using testing::FieldsAre;

ManipulatorParameters good() { return parseScenario(good_scenario, "a.toml").manipulator->parameters(); }

using Machine = ManipulatorParameters;

struct Refusal {
  const char* name;
  void (*fault)(Machine&);
  const char* place;
  const char* value;
  const char* bound;
};

class RefusedManipulator : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedManipulator, namesPlaceValueAndBound) {
  Machine machine = good();
  EXPECT_NO_THROW(Manipulator{machine});
  GetParam().fault(machine);
  EXPECT_THAT(refusedParameter([&] { Manipulator{machine}; }),
              FieldsAre(std::string("manipulator.") + GetParam().place, HasSubstr(GetParam().value),
                        HasSubstr(GetParam().bound)));
}

const Refusal refusals[] = {
    {"gravity", [](auto& m) { m.gravity.z() = nan; }, "gravity", "nan", "finite numbers"},
    {"mass_zero", [](auto& m) { m.platform.mass = 0; }, "platform.mass", "0", "> 0"},
    {"mass_nan", [](auto& m) { m.platform.mass = nan; }, "platform.mass", "nan", "finite"},
    {"mass_inf", [](auto& m) { m.platform.mass = inf; }, "platform.mass", "inf", "finite"},
    {"centre", [](auto& m) { m.platform.center_of_mass.x() = inf; }, "platform.center_of_mass", "inf",
     "finite numbers"},
    {"inertia_nan", [](auto& m) { m.platform.inertia(1, 2) = nan; }, "platform.inertia", "non-finite",
     "finite numbers"},
    {"asymmetric", [](auto& m) { m.platform.inertia(0, 1) = 1; }, "platform.inertia", "not symmetric",
     "a symmetric tensor"},
    {"indefinite", [](auto& m) { m.platform.inertia(0, 0) = -1; }, "platform.inertia", "principal moments [-1, 810",
     "all principal moments > 0"},
    {"off_diagonal", [](auto& m) { m.platform.inertia(0, 1) = m.platform.inertia(1, 0) = 900; }, "platform.inertia",
     "principal moments [-", "all principal moments > 0"},
    {"triangle", [](auto& m) { m.platform.inertia(2, 2) = 1610.1; }, "platform.inertia", "[800, 810, 1610.1]",
     "<= the sum of the others, 1610"},
    {"base_point", [](auto& m) { m.legs[0].base_point.x() = nan; }, "leg[1].base_point", "nan", "finite numbers"},
    {"axis_zero", [](auto& m) { m.legs[5].base_axis.setZero(); }, "leg[6].base_axis", "[0, 0, 0]", "not zero"},
    {"axis_nan", [](auto& m) { m.legs[5].base_axis.y() = nan; }, "leg[6].base_axis", "nan", "finite numbers"},
    {"platform_point", [](auto& m) { m.legs[2].platform_point.z() = -inf; }, "leg[3].platform_point", "-inf",
     "finite numbers"},
    {"length", [](auto& m) { m.legs[1].proximal.length = 0; }, "leg[2].proximal.length", "0", "> 0"},
    {"link_mass", [](auto& m) { m.legs[1].distal.mass = -2; }, "leg[2].distal.mass", "-2", ">= 0"},
    {"link_without_mass", [](auto& m) { m.legs[1].distal.mass = 0; }, "leg[2].distal.inertia", "0.015]",
     "zero, as the link's mass is 0"},
    {"link_centre", [](auto& m) { m.legs[1].distal.center_of_mass = nan; }, "leg[2].distal.center_of_mass", "nan",
     "finite"},
    {"link_inertia", [](auto& m) { m.legs[4].proximal.inertia(0, 0) = 0; }, "leg[5].proximal.inertia",
     "principal moments [0, ", "> 0"},
    {"rod_not_round", [](auto& m) { m.legs[4].distal.inertia = Vector3d(4, 4.1, 0).asDiagonal(); },
     "leg[5].distal.inertia", "[0, 4, 4.1]", "<= the sum of the others"},
    {"rod_with_product",
     [](auto& m) {
       m.legs[4].distal.inertia(2, 2) = 0, m.legs[4].distal.inertia(0, 2) = m.legs[4].distal.inertia(2, 0) = 0.1;
     },
     "leg[5].distal.inertia", "principal moments [-", "of a thin rod"},
    {"off_line_along", [](auto& m) { m.legs[1].distal.off_line.z() = 0.1; }, "leg[2].distal.center_of_mass", "0.1",
     "across the link's line"},
    {"off_line_nan", [](auto& m) { m.legs[1].distal.off_line.x() = nan; }, "leg[2].distal.center_of_mass", "nan",
     "finite"},
    {"rotor_negative", [](auto& m) { m.legs[3].rotor_inertia.phi = -1; }, "leg[4].rotor_inertia.phi", "-1", ">= 0"},
    {"rotor_nan", [](auto& m) { m.legs[3].rotor_inertia.phi = nan; }, "leg[4].rotor_inertia.phi", "nan", "finite"},
    {"rotor_undriven", [](auto& m) { m.legs[3].rotor_inertia.theta = 2; }, "leg[4].rotor_inertia.theta", "2",
     "no motor drives theta"},
    {"rotor_elsewhere", [](auto& m) { m.legs[3].rotor_inertia.d = 2; }, "leg[4].rotor_inertia.d", "2",
     "no motor drives d"},
    {"spin", [](auto& m) { m.legs[3].spins = true; }, "leg[4].spin", "URS", "held"},
    {"friction_actuated", [](auto& m) { m.legs[3].friction.phi = -1; }, "leg[4].friction.phi", "-1", ">= 0"},
    {"friction_universal", [](auto& m) { m.legs[3].friction.psi = nan; }, "leg[4].friction.psi", "nan", "finite"},
    {"friction_knee", [](auto& m) { m.legs[3].friction.theta = -1e-300; }, "leg[4].friction.theta", "-1e-300", ">= 0"},
    {"coulomb", [](auto& m) { m.legs[3].coulomb.theta = -1; }, "leg[4].coulomb.theta", "-1", ">= 0"},
    {"smoothing", [](auto& m) { m.legs[3].coulomb.smoothing_speed = 0; }, "leg[4].coulomb.smoothing_speed", "0", "> 0"},
    {"span", [](auto& m) { m.legs[4].base_point.x() = 40; }, "leg[1]", "l + s of legs 1 and 5 together 5.",
     "by which their base and platform distances differ"},
    {"millimetres", [](auto& m) { m.legs[4].base_point.x() = 1300; }, "leg[1].base_point",
     "l + s of legs 1 and 5 together 5.", "did you mean mm? 1"},
};
INSTANTIATE_TEST_SUITE_P(Machines, RefusedManipulator, testing::ValuesIn(refusals),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Manipulator, keepsWhatItWasGiven) {
  Machine machine = good();
  machine.legs[2].friction.theta = 0.75;
  machine.gravity = {1, 2, 3};
  const Manipulator manipulator(machine);
  EXPECT_EQ(manipulator.leg(2).friction.theta, 0.75);
  EXPECT_EQ(manipulator.gravity(), Vector3d(1, 2, 3));
  EXPECT_EQ(manipulator.platform().mass, 500);
}

TEST(Manipulator, acceptsAThinRod) {
  Machine machine = good();
  machine.legs[2].distal.inertia = Vector3d(4, 4, 0).asDiagonal();
  EXPECT_EQ(Manipulator(machine).leg(2).distal.inertia(2, 2), 0);
  machine.legs[2].distal.inertia(0, 0) = 4 * (1 + 1e-15);  // the triangle inequality allows for rounding
  EXPECT_NO_THROW(Manipulator{machine});
  machine.platform.inertia = Vector3d(4, 4, 0).asDiagonal();
  EXPECT_THROW(Manipulator{machine}, InvalidParameter);
}

Machine spinning() {
  Machine machine = good();
  for (Leg& leg : machine.legs) {
    leg.kind = LegKind::UPS;
    leg.actuated = {false, false, true};
    leg.proximal.inertia = Vector3d(4, 4, 2).asDiagonal();
    leg.distal.inertia = Vector3d(3, 3, 1).asDiagonal();
    leg.spins = true;
  }
  return machine;
}

/// Its momentum about its line stays zero, so it has no effect.
TEST(Manipulator, takesNoMomentAboutTheLineOfWhatSpins) {
  const Manipulator manipulator(spinning());
  EXPECT_EQ(manipulator.leg(1).proximal.inertia, Matrix3d(Vector3d(4, 4, 0).asDiagonal()));
  EXPECT_EQ(manipulator.leg(1).distal.inertia, Matrix3d(Vector3d(3, 3, 0).asDiagonal()));
  EXPECT_EQ(manipulator.given().legs[1].distal.inertia(2, 2), 1);
  EXPECT_NO_THROW(Manipulator(manipulator.parameters()));
  Machine crank = spinning();
  crank.legs[0].kind = LegKind::RUS;
  crank.legs[0].actuated = {true, false, false};
  EXPECT_EQ(Manipulator(crank).leg(0).proximal.inertia(2, 2), 2);
}

TEST(Manipulator, spinsOnlyWhatIsRound) {
  for (const auto& change : std::vector<std::function<void(Link&)>>{
           [](Link& link) { link.inertia(0, 0) = 3.5; }, [](Link& link) { link.off_line.x() = 0.01; },
           [](Link& link) { link.inertia(0, 2) = link.inertia(2, 0) = 0.01; }})
    for (const bool first : {true, false}) {
      Machine machine = spinning();
      change(first ? machine.legs[3].proximal : machine.legs[3].distal);
      EXPECT_THROW(Manipulator{machine}, InvalidParameter);
      machine.legs[3].spins = false;
      EXPECT_NO_THROW(Manipulator{machine});
    }
}

TEST(Manipulator, acceptsALaminaInAnyAttitude) {
  Machine machine = good();
  const Matrix3d Q = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Matrix3d lamina = Q * Vector3d(1, 2, 3).asDiagonal() * Q.transpose();
  machine.platform.inertia = (lamina + lamina.transpose()) / 2;
  EXPECT_NO_THROW(Manipulator{machine});
  machine.platform.inertia += Matrix3d(1e-9 * Q.col(2) * Q.col(2).transpose());
  machine.platform.inertia = Matrix3d((machine.platform.inertia + machine.platform.inertia.transpose()) / 2);
  EXPECT_THROW(Manipulator{machine}, InvalidParameter);
}

TEST(Manipulator, acceptsLegsThatJustReach) {
  // Base and platform edges of legs 1 and 5 differ by 1 mm less, and then 1 mm more, than both stretched legs can
  // bridge.
  Machine machine = good();
  for (Leg& leg : machine.legs) leg.base_point = leg.platform_point = Vector3d::Zero();
  machine.legs[4].base_point = {5.399, 0, 0};
  EXPECT_NO_THROW(Manipulator{machine});
  machine.legs[4].base_point = {5.401, 0, 0};
  EXPECT_THROW(Manipulator{machine}, InvalidParameter);
}

}  // namespace
}  // namespace ursula
