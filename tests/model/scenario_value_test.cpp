// Values that a scenario can express but no machine, setting or file can have, with the whole message. An @ marks the
// place.

#include <gmock/gmock.h>

#include "model/scenario.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"

namespace ursula {
namespace {

using testing::EndsWith;
using testing::StartsWith;

struct Refusal {
  const char* name;
  const char* from;
  const char* to;
  const char* message;
};

std::string nameOf(const testing::TestParamInfo<Refusal>& row) { return row.param.name; }

class ImpossibleScenario : public testing::TestWithParam<Refusal> {};

TEST_P(ImpossibleScenario, isRefusedAtTheKey) {
  const MarkedText changed = marked(replaced(good_scenario, GetParam().from, GetParam().to));
  EXPECT_EQ(refusal<ScenarioError>([&] { parseScenario(changed.text, "a.toml"); }),
            "a.toml:" + changed.place + ": error: " + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Machine, ImpossibleScenario,
    testing::Values(
        Refusal{"mass", "mass = 500.0", "mass = @-500.0", "manipulator.platform.mass: -500, expected > 0"},
        Refusal{"inherited", "length = 1.4, mass = 10.0", "length = 1.4, mass = @0",
                "manipulator.leg_defaults.proximal.mass (of leg 1): 0, expected > 0"},
        Refusal{"own", "[-0.0667, -1.3847, 0.0]", "[-0.0667, -1.3847, 0.0]\ndistal = { mass = @-1 }",
                "manipulator.leg[1].distal.mass: -1, expected > 0"},
        Refusal{"axis", "[0.9397, 0.0, 0.3420]", "@[0, 0, 0]",
                "manipulator.leg[2].base_axis: [0, 0, 0], expected a vector that is not zero"},
        Refusal{"triangle", "[800.0, 810.0, 820.0]", "@[800, 10, 820]",
                "manipulator.platform.inertia: principal moments [10, 800, 820], expected the largest principal moment "
                "<= the sum of the others, 810"},
        Refusal{"friction", "knee = 0.125", "knee = @-0.125",
                "manipulator.leg_defaults.friction.knee (of leg 1): -0.125, expected >= 0"},
        Refusal{"rotor", "friction = {", "rotor_inertia = { phi = @-0.5 }\nfriction = {",
                "manipulator.leg_defaults.rotor_inertia.phi (of leg 1): -0.5, expected >= 0"},
        Refusal{"spin", "friction = {", "spin = @\"free\"\nfriction = {",
                "manipulator.leg_defaults.spin (of leg 1): \"free\" of a URS leg, expected \"held\": its links cannot "
                "turn about their lines"},
        Refusal{"coulomb", "friction = {", "coulomb = { smoothing_speed = @0.0 }\nfriction = {",
                "manipulator.leg_defaults.coulomb.smoothing_speed (of leg 1): 0, expected > 0"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Settings, ImpossibleScenario,
    testing::Values(
        Refusal{"samples_low", "[trajectory]", "[simulation]\nsamples = @1\n[trajectory]",
                "simulation.samples: 1, expected an integer from 2 to 1000000"},
        Refusal{"samples_high", "[trajectory]", "[simulation]\nsamples = @1000001\n[trajectory]",
                "simulation.samples: 1000001, expected an integer from 2 to 1000000"},
        Refusal{"samples_huge", "[trajectory]", "[simulation]\nsamples = @5000000000\n[trajectory]",
                "simulation.samples: 5000000000, expected an integer of 32 bits"},
        Refusal{"samples_float", "[trajectory]", "[simulation]\nsamples = @301.0\n[trajectory]",
                "simulation.samples: a float, expected an integer"},
        Refusal{"integrator", "[trajectory]", "[simulation]\nintegrator = @\"rkf87\"\n[trajectory]",
                "simulation.integrator: 'rkf87', expected 'rkf78' or 'rk_merson', did you mean 'rkf78'?"},
        Refusal{"tolerance", "[trajectory]", "[simulation]\ntolerance = @1e-16\n[trajectory]",
                "simulation.tolerance: 1e-16, expected a number from 1e-15 to 1e-3"},
        Refusal{"limit_zero", "[trajectory]", "[acceptance]\n\"closure.position\" = @0\n[trajectory]",
                "acceptance.closure.position: 0, expected a number > 0"},
        Refusal{"limit_word", "[trajectory]", "[acceptance]\nreplay.position = @\"small\"\n[trajectory]",
                "acceptance.replay.position: a string, expected a number"},
        Refusal{"limit_twice", "[trajectory]",
                "[acceptance]\nenergy.balance = 1\n\"energy.balance\" = @2\n[trajectory]",
                "acceptance.energy.balance: a second limit for one check, expected one"},
        Refusal{"limit_misspelt", "[trajectory]", "[acceptance]\ntorque.pontwise = @2\n[trajectory]",
                "acceptance.torque.pontwise: 'torque.pontwise' is not a check, did you mean 'torque.pointwise'?"},
        Refusal{"tolerance_misspelt", "[trajectory]", "[acceptance]\ntorqe.relative = @2\n[trajectory]",
                "acceptance.torqe.relative: 'torqe.relative' is not a check, did you mean 'torque.relative'?"},
        Refusal{"tolerance_no_share", "[trajectory]", "[acceptance]\ntorque.relative = @\"1 of 9\"\n[trajectory]",
                "acceptance.torque.relative: '1 of 9', expected a number or a percentage, such as 0.01 or \"1%\""}),
    nameOf);

TEST(ImpossibleScenario, hasLegsTooShort) {
  const MarkedText changed = marked(replaced(good_scenario, "[[manipulator.leg]]\nbase_point = [-0.0953",
                                             "@[[manipulator.leg]]\nbase_point = [-20.0"));
  EXPECT_THAT(refusal<ScenarioError>([&] { parseScenario(changed.text, "a.toml"); }),
              StartsWith("a.toml:" + changed.place + ": error: manipulator.leg[1]: l + s of legs 1 and 2 together 5."));
}

TEST(ImpossibleScenario, hasFiveLegs) {
  const auto last = good_scenario.rfind("[[manipulator.leg]]"), end = good_scenario.find("[trajectory]");
  const std::string five = good_scenario.substr(0, last) + good_scenario.substr(end);
  const MarkedText changed = marked(replaced(five, "[[manipulator.leg]]", "@[[manipulator.leg]]"));
  EXPECT_EQ(
      refusal<ScenarioError>([&] { parseScenario(changed.text, "a.toml"); }),
      "a.toml:" + changed.place +
          ": error: manipulator.leg: 5 actuated coordinates of 5 legs in all, expected exactly 6: is a leg missing, "
          "or a motor in its 'actuated'?");
}

TEST(ImpossibleScenario, hasSevenLegs) {
  const std::string seventh = "@[[manipulator.leg]]\nbase_point = [1, 2, 3]\n\n[trajectory]";
  const MarkedText changed = marked(replaced(good_scenario, "[trajectory]", seventh));
  EXPECT_EQ(refusal<ScenarioError>([&] { parseScenario(changed.text, "a.toml"); }),
            "a.toml:" + changed.place +
                ": error: manipulator.leg[7]: a surplus leg, expected three to six [[manipulator.leg]]");
}

TEST(ImpossibleScenario, hasNoLegs) {
  const std::string none = good_scenario.substr(0, good_scenario.find("[[manipulator.leg]]")) +
                           good_scenario.substr(good_scenario.find("[trajectory]"));
  const MarkedText changed = marked(replaced(none, "[manipulator]", "@[manipulator]"));
  EXPECT_EQ(refusal<ScenarioError>([&] { parseScenario(changed.text, "a.toml"); }),
            "a.toml:" + changed.place +
                ": error: missing key 'leg' in manipulator, expected three to six [[manipulator.leg]]");
}

TEST(ImpossibleScenario, isNotToml) {
  EXPECT_THAT(
      refusal<ScenarioError>([] { parseScenario("a = 1\nb = = 2\n", "a.toml"); }),
      testing::AllOf(StartsWith("a.toml:2:5: error: while parsing value: "), EndsWith(", expected valid TOML")));
  EXPECT_THAT(refusal<ScenarioError>([] { parseScenario("a = 1\nmass = 142,0 # kg\n", "a.toml"); }),
              testing::AllOf(StartsWith("a.toml:2:"),
                             EndsWith(": expected a comment or whitespace, saw ',', did you mean 142.0?")));
  EXPECT_THAT(refusal<ScenarioError>([] { parseScenario("mass = 1\nmass = 2\n", "a.toml"); }),
              testing::AllOf(StartsWith("a.toml:2:"), testing::HasSubstr("redefine")));
}

TEST(ImpossibleScenario, cannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal<ScenarioError>([&] { readScenario(folder.path() / "none.toml"); }),
              EndsWith("none.toml: error: no such file, expected a scenario in TOML"));
  EXPECT_THAT(refusal<ScenarioError>([&] { readScenario(folder.path()); }),
              EndsWith(": error: a folder, expected a scenario in TOML"));
}

}  // namespace
}  // namespace ursula
