// Every way in which the machine and the settings of a scenario can be wrong, with the whole message. An @ in the
// changed text marks the place that the message must name. Types, bounds and names of all keys are tried by
// scenario_keys_test.cpp.

#include "model/scenario.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

struct Refusal {
  const char* name;
  const char* from;
  const char* to;
  const char* message;
};

std::string nameOf(const testing::TestParamInfo<Refusal>& row) { return row.param.name; }

class RefusedScenario : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedScenario, saysWhereWhatAndWhatWasExpected) {
  EXPECT_EQ(refusalAtMark(replaced(good_scenario, GetParam().from, GetParam().to)), GetParam().message);
}

TEST(RefusedScenario, isAcceptedWithoutTheChange) { EXPECT_NO_THROW(parseScenario(good_scenario, "a.toml")); }

const std::string long_name = "@\"" + std::string(256, 'a') + "\"";
const Refusal name_refusals[] = {
    {"missing", "name = \"small\"", "@", "missing key 'name', expected a string"},
    {"number", "name = \"small\"", "name = @3", "name: an integer, expected a string"},
    {"empty", "\"small\"", "@\"\"", "name: '', expected a name that a folder can have, without '/'"},
    {"dot", "\"small\"", "@\".\"", "name: '.', expected a name that a folder can have, without '/'"},
    {"dots", "\"small\"", "@\"..\"", "name: '..', expected a name that a folder can have, without '/'"},
    {"long", "\"small\"", long_name.c_str(), "name: 256 bytes, expected a name that a folder can have, of at most 255"},
    {"slash", "\"small\"", "@\"a/b\"", "name: 'a/b', expected a name that a folder can have, without '/'"},
};
INSTANTIATE_TEST_SUITE_P(Name, RefusedScenario, testing::ValuesIn(name_refusals), nameOf);

const Refusal keys_refusals[] = {
    {"top", "[trajectory]", "[@trajetory]",
     "unknown key 'trajetory', expected 'name', 'manipulator', 'trajectory', 'load', 'simulation' or "
     "'acceptance', did you mean 'trajectory'?"},
    {"acceptance", "[trajectory]", "[acceptance]\ntorque = @{}\n[trajectory]",
     "acceptance.torque: an empty table, expected a limit, or for torque relative or absolute"},
    {"leg", "base_axis = [0.9397", "@base_axes = [0.9397",
     "unknown key 'base_axes' in manipulator.leg[2], expected 'kind', 'actuated', 'base_point', "
     "'base_axis', 'platform_point', 'proximal', 'distal', 'knee', 'friction', 'coulomb', 'rotor_inertia' "
     "or 'spin', did you mean 'base_axis'?"},
    {"rotor_undriven", "friction = {", "rotor_inertia = { psi = @1 }\nfriction = {",
     "manipulator.leg_defaults.rotor_inertia.psi: 1, but no motor drives psi, expected 'phi'"},
    {"rotor_of_one_leg", "[-0.0667, -1.3847, 0.0]", "[-0.0667, -1.3847, 0.0]\nrotor_inertia = { d = @1 }",
     "manipulator.leg[1].rotor_inertia.d: 1, but no motor drives d of this leg, expected 'phi'"},
};
INSTANTIATE_TEST_SUITE_P(Keys, RefusedScenario, testing::ValuesIn(keys_refusals), nameOf);

const Refusal missing_refusals[] = {
    {"platform_mass", "[manipulator.platform]\nmass = 500.0", "@[manipulator.platform]",
     "missing key 'mass' in manipulator.platform, expected a number"},
    {"platform_centre", "[manipulator.platform]\nmass = 500.0\ncenter_of_mass = [0.0, 0.0, 1.88]",
     "@[manipulator.platform]\nmass = 500",
     "missing key 'center_of_mass' in manipulator.platform, expected an array of 3 numbers"},
    {"platform_inertia",
     "[manipulator.platform]\nmass = 500.0\ncenter_of_mass = [0.0, 0.0, 1.88]\ninertia = [800.0, 810.0, 820.0]",
     "@[manipulator.platform]\nmass = 1\ncenter_of_mass = [0, 0, 0]",
     "missing key 'inertia' in manipulator.platform, expected an array of 3 or 6 numbers"},
    {"leg_point", "[[manipulator.leg]]\nbase_point = [0.0953, -1.9682, 0.0]", "@[[manipulator.leg]]",
     "missing key 'base_point' in manipulator.leg[2], expected an array of 3 numbers here or in "
     "manipulator.leg_defaults"},
    {"trajectory_key", "[trajectory]\nkind = \"helix\"\nduration = 3.0\n", "@[trajectory]\nkind = \"helix\"\n",
     "missing key 'duration' in trajectory, expected a number"},
};
INSTANTIATE_TEST_SUITE_P(Missing, RefusedScenario, testing::ValuesIn(missing_refusals), nameOf);

TEST(RefusedScenario, namesAMissingTable) {
  EXPECT_EQ(refusalAtMark("@name = \"x\"\n"),
            "missing key 'manipulator', expected a table [manipulator] or [mechanism]");
  EXPECT_EQ(refusalAtMark("name = \"x\"\n@[manipulator]\ngravity = [0, 0, 1]\n"),
            "missing key 'platform' in manipulator, expected a table");
  const std::string without_trajectory = good_scenario.substr(0, good_scenario.find("[trajectory]"));
  EXPECT_EQ(refusalAtMark("@" + without_trajectory), "missing key 'trajectory', expected a table");
}

TEST(RefusedScenario, namesTheLegThatNeitherItNorTheDefaultsCompletes) {
  const std::string without_mass = replaced(good_scenario, "length = 1.4, mass = 10.0,", "length = 1.4,");
  EXPECT_EQ(refusalAtMark(replaced(without_mass, "[[manipulator.leg]]", "@[[manipulator.leg]]")),
            "missing key 'proximal.mass' in manipulator.leg[1], expected a number here or in manipulator.leg_defaults");
  const std::string without_inertia = replaced(good_scenario, ", inertia = [3.3, 3.3, 0.015]", "");
  EXPECT_EQ(refusalAtMark(replaced(without_inertia, "[[manipulator.leg]]", "@[[manipulator.leg]]")),
            "missing key 'distal.inertia' in manipulator.leg[1], expected an array of 3 or 6 numbers here or in "
            "manipulator.leg_defaults");
}

const Refusal types_refusals[] = {
    {"date_mass", "mass = 500.0", "mass = @2026-01-01", "manipulator.platform.mass: a date or time, expected a number"},
    {"nan_mass", "mass = 500.0", "mass = @nan", "manipulator.platform.mass: nan, expected a finite number"},
    {"inf_mass", "mass = 500.0", "mass = @-inf", "manipulator.platform.mass: -inf, expected a finite number"},
    {"short_vector", "[0.0, 0.0, 1.88]", "@[0.0, 1.88]",
     "manipulator.platform.center_of_mass: an array of 2, expected an array of 3 numbers"},
    {"nan_in_vector", "[0.0, 0.0, 1.88]", "[0.0, @nan, 1.88]",
     "manipulator.platform.center_of_mass[2]: nan, expected a finite number"},
    {"string_in_vector", "[0.0, 0.0, 1.88]", "[0.0, 0.0, @'x']",
     "manipulator.platform.center_of_mass[3]: a string, expected a number"},
    {"inertia_of_four", "[800.0, 810.0, 820.0]", "@[800.0, 810.0, 820.0, 0.0]",
     "manipulator.platform.inertia: an array of 4, expected an array of 3 or 6 numbers"},
    {"platform",
     "[manipulator.platform]\nmass = 500.0\ncenter_of_mass = [0.0, 0.0, 1.88]\n"
     "inertia = [800.0, 810.0, 820.0]\n",
     "platform = @5\n", "manipulator.platform: an integer, expected a table"},
    {"knee", "friction = {", "knee = @1\nfriction = {",
     "manipulator.leg_defaults.knee: an integer, expected 'positive' or 'negative'"},
    {"knee_word", "friction = {", "knee = @\"postive\"\nfriction = {",
     "manipulator.leg_defaults.knee: 'postive', expected 'positive' or 'negative', did you mean 'positive'?"},
};
INSTANTIATE_TEST_SUITE_P(Types, RefusedScenario, testing::ValuesIn(types_refusals), nameOf);

const Refusal machine_refusals[] = {
    {"inherited", "length = 1.4, mass = 10.0", "length = 1.4, mass = @-10.0",
     "manipulator.leg_defaults.proximal.mass (of leg 1): -10, expected >= 0"},
    {"without_mass", "mass = 10.0, center_of_mass = 0.7, inertia = ", "mass = 0, center_of_mass = 0.7, inertia = @",
     "manipulator.leg_defaults.proximal.inertia (of leg 1): [4.2, 4.2, 0.015], expected zero, "
     "as the link's mass is 0"},
    {"own", "[-0.0667, -1.3847, 0.0]", "[-0.0667, -1.3847, 0.0]\ndistal = { mass = @-1 }",
     "manipulator.leg[1].distal.mass: -1, expected >= 0"},
    {"axis", "[0.9397, 0.0, 0.3420]", "@[0, 0, 0]",
     "manipulator.leg[2].base_axis: [0, 0, 0], expected a vector that is not zero"},
    {"triangle", "[800.0, 810.0, 820.0]", "@[800, 10, 820]",
     "manipulator.platform.inertia: principal moments [10, 800, 820], expected the largest "
     "principal moment <= the sum of the others, 810"},
    {"spin", "friction = {", "spin = @\"free\"\nfriction = {",
     "manipulator.leg_defaults.spin (of leg 1): \"free\" of a URS leg, expected \"held\": its "
     "links cannot turn about their lines"},
};
INSTANTIATE_TEST_SUITE_P(Machine, RefusedScenario, testing::ValuesIn(machine_refusals), nameOf);

const Refusal settings_refusals[] = {
    {"samples_huge", "[trajectory]", "[simulation]\nsamples = @5000000000\n[trajectory]",
     "simulation.samples: 5000000000, expected an integer of 32 bits"},
    {"integrator", "[trajectory]", "[simulation]\nintegrator = @\"rkf87\"\n[trajectory]",
     "simulation.integrator: 'rkf87', expected 'rkf78' or 'rk_merson', did you mean 'rkf78'?"},
    {"limit_zero", "[trajectory]", "[acceptance]\n\"closure.position\" = @0\n[trajectory]",
     "acceptance.closure.position: 0, expected a number > 0"},
    {"limit_word", "[trajectory]", "[acceptance]\nreplay.position = @\"small\"\n[trajectory]",
     "acceptance.replay.position: a string, expected a number"},
    {"limit_twice", "[trajectory]", "[acceptance]\nenergy.balance = 1\n\"energy.balance\" = @2\n[trajectory]",
     "acceptance.energy.balance: a second limit for one check, expected one"},
    {"limit_misspelt", "[trajectory]", "[acceptance]\ntorque.pontwise = @2\n[trajectory]",
     "acceptance.torque.pontwise: 'torque.pontwise' is not a check, did you mean 'torque.pointwise'?"},
    {"tolerance_misspelt", "[trajectory]", "[acceptance]\ntorqe.relative = @2\n[trajectory]",
     "acceptance.torqe.relative: 'torqe.relative' is not a check, did you mean 'torque.relative'?"},
    {"tolerance_number", "[trajectory]", "[acceptance]\ntorque = @1e-3\n[trajectory]",
     "acceptance.torque: a float, expected a table { relative = X, absolute = Y }"},
    {"tolerance_number_elsewhere", "[trajectory]", "[acceptance]\ntorqe = @1e-3\n[trajectory]",
     "acceptance.torqe: 'torqe' is not a check"},
    {"tolerance_no_share", "[trajectory]", "[acceptance]\ntorque.relative = @\"1 of 9\"\n[trajectory]",
     "acceptance.torque.relative: '1 of 9', expected a number or a percentage, such as 0.01 or \"1%\""},
};
INSTANTIATE_TEST_SUITE_P(Settings, RefusedScenario, testing::ValuesIn(settings_refusals), nameOf);

TEST(RefusedScenario, hasLegsTooShort) {
  EXPECT_THAT(refusalAtMark(replaced(good_scenario, "[[manipulator.leg]]\nbase_point = [-0.0953",
                                     "@[[manipulator.leg]]\nbase_point = [-20.0")),
              StartsWith("manipulator.leg[1]: l + s of legs 1 and 2 together 5."));
}

TEST(RefusedScenario, hasAnotherNumberOfLegs) {
  const auto first = good_scenario.find("[[manipulator.leg]]"), last = good_scenario.rfind("[[manipulator.leg]]"),
             end = good_scenario.find("[trajectory]");
  const std::string five = good_scenario.substr(0, last) + good_scenario.substr(end),
                    none = good_scenario.substr(0, first) + good_scenario.substr(end),
                    seventh = "@[[manipulator.leg]]\nbase_point = [1, 2, 3]\n\n[trajectory]";
  EXPECT_EQ(refusalAtMark(replaced(five, "[[manipulator.leg]]", "@[[manipulator.leg]]")),
            "manipulator.leg: 5 actuated coordinates of 5 legs in all, expected exactly 6: is a leg missing, or a "
            "motor in its 'actuated'?");
  EXPECT_EQ(refusalAtMark(replaced(good_scenario, "[trajectory]", seventh)),
            "manipulator.leg[7]: a surplus leg, expected three to six [[manipulator.leg]]");
  EXPECT_EQ(refusalAtMark(replaced(none, "[manipulator]", "@[manipulator]")),
            "missing key 'leg' in manipulator, expected three to six [[manipulator.leg]]");
}

TEST(RefusedScenario, isNotToml) {
  EXPECT_THAT(refusal<ScenarioError>([] { parseScenario("a = 1\nb = = 2\n", "a.toml"); }),
              AllOf(StartsWith("a.toml:2:5: error: while parsing value: "), EndsWith(", expected valid TOML")));
  EXPECT_THAT(
      refusal<ScenarioError>([] { parseScenario("a = 1\nmass = 142,0 # kg\n", "a.toml"); }),
      AllOf(StartsWith("a.toml:2:"), EndsWith(": expected a comment or whitespace, saw ',', did you mean 142.0?")));
  EXPECT_THAT(refusal<ScenarioError>([] { parseScenario("mass = 1\nmass = 2\n", "a.toml"); }),
              AllOf(StartsWith("a.toml:2:"), HasSubstr("redefine")));
}

TEST(RefusedScenario, cannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal<ScenarioError>([&] { readScenario(folder.path() / "none.toml"); }),
              EndsWith("none.toml: error: no such file, expected a scenario in TOML"));
  EXPECT_THAT(refusal<ScenarioError>([&] { readScenario(folder.path()); }),
              EndsWith(": error: a folder, expected a scenario in TOML"));
}

}  // namespace
}  // namespace ursula
