// Every way in which the machine and the settings of a scenario can be wrong, with the whole message. An @ in the
// changed text marks the place that the message must name.

#include <gmock/gmock.h>

#include "model/scenario.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"

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
  const MarkedText changed = marked(replaced(good_scenario, GetParam().from, GetParam().to));
  EXPECT_EQ(refusal<ScenarioError>([&] { parseScenario(changed.text, "a.toml"); }),
            "a.toml:" + changed.place + ": error: " + GetParam().message);
}

TEST(RefusedScenario, isAcceptedWithoutTheChange) { EXPECT_NO_THROW(parseScenario(good_scenario, "a.toml")); }

INSTANTIATE_TEST_SUITE_P(
    Name, RefusedScenario,
    testing::Values(
        Refusal{"missing", "name = \"small\"", "@", "missing key 'name', expected a string"},
        Refusal{"number", "name = \"small\"", "name = @3", "name: an integer, expected a string"},
        Refusal{"empty", "\"small\"", "@\"\"", "name: '', expected a name that a folder can have, without '/'"},
        Refusal{"dot", "\"small\"", "@\".\"", "name: '.', expected a name that a folder can have, without '/'"},
        Refusal{"dots", "\"small\"", "@\"..\"", "name: '..', expected a name that a folder can have, without '/'"},
        Refusal{"slash", "\"small\"", "@\"a/b\"", "name: 'a/b', expected a name that a folder can have, without '/'"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Keys, RefusedScenario,
    testing::Values(
        Refusal{"top", "[trajectory]", "[@trajetory]",
                "unknown key 'trajetory', expected 'name', 'manipulator', 'trajectory', 'load', 'simulation' or "
                "'acceptance', did you mean 'trajectory'?"},
        Refusal{"acceptance", "[trajectory]", "[acceptance]\ntorque = @{}\n[trajectory]",
                "acceptance.torque: an empty table, expected a limit, or for torque relative or absolute"},
        Refusal{"manipulator", "[manipulator]\n", "[manipulator]\n@gravty = [0, 0, -9.81]\n",
                "unknown key 'gravty' in manipulator, expected 'gravity', 'platform', 'leg_defaults' or 'leg', did you "
                "mean 'gravity'?"},
        Refusal{
            "platform", "mass = 500.0", "@mas = 500.0",
            "unknown key 'mas' in manipulator.platform, expected 'mass', 'center_of_mass' or 'inertia', did you mean "
            "'mass'?"},
        Refusal{
            "link", "length = 1.4", "@lenght = 1.4",
            "unknown key 'lenght' in manipulator.leg_defaults.proximal, expected 'length', 'mass', 'center_of_mass' "
            "or 'inertia', did you mean 'length'?"},
        Refusal{
            "leg", "base_axis = [0.9397", "@base_axes = [0.9397",
            "unknown key 'base_axes' in manipulator.leg[2], expected 'kind', 'actuated', 'base_point', 'base_axis', "
            "'platform_point', 'proximal', 'distal', 'knee', 'friction', 'coulomb', 'rotor_inertia' or 'spin', did you "
            "mean 'base_axis'?"},
        Refusal{"rotor", "friction = {", "rotor_inertia = { @actuated = 1 }\nfriction = {",
                "unknown key 'actuated' in manipulator.leg_defaults.rotor_inertia, expected 'phi', 'psi', 'theta' or "
                "'d'"},
        Refusal{"rotor_undriven", "friction = {", "rotor_inertia = { psi = @1 }\nfriction = {",
                "manipulator.leg_defaults.rotor_inertia.psi: 1, but no motor drives psi, expected 'phi'"},
        Refusal{"rotor_of_one_leg", "[-0.0667, -1.3847, 0.0]", "[-0.0667, -1.3847, 0.0]\nrotor_inertia = { d = @1 }",
                "manipulator.leg[1].rotor_inertia.d: 1, but no motor drives d of this leg, expected 'phi'"},
        Refusal{"friction", "universal = 0.25", "@univeral = 0.25",
                "unknown key 'univeral' in manipulator.leg_defaults.friction, expected 'phi', 'psi', 'theta', 'd', "
                "'actuated', 'universal' or "
                "'knee', did you mean 'universal'?"},
        Refusal{"coulomb", "friction = {", "coulomb = { @speed = 1 }\nfriction = {",
                "unknown key 'speed' in manipulator.leg_defaults.coulomb, expected 'phi', 'psi', 'theta', 'd', "
                "'actuated', 'universal', 'knee' or "
                "'smoothing_speed'"},
        Refusal{"simulation", "[trajectory]", "[simulation]\n@sample = 3\n[trajectory]",
                "unknown key 'sample' in simulation, expected 'samples', 'integrator' or 'tolerance', did you mean "
                "'samples'?"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Missing, RefusedScenario,
    testing::Values(
        Refusal{"platform_mass", "[manipulator.platform]\nmass = 500.0", "@[manipulator.platform]",
                "missing key 'mass' in manipulator.platform, expected a number"},
        Refusal{"platform_centre", "[manipulator.platform]\nmass = 500.0\ncenter_of_mass = [0.0, 0.0, 1.88]",
                "@[manipulator.platform]\nmass = 500",
                "missing key 'center_of_mass' in manipulator.platform, expected an array of 3 numbers"},
        Refusal{
            "platform_inertia",
            "[manipulator.platform]\nmass = 500.0\ncenter_of_mass = [0.0, 0.0, 1.88]\ninertia = [800.0, 810.0, 820.0]",
            "@[manipulator.platform]\nmass = 1\ncenter_of_mass = [0, 0, 0]",
            "missing key 'inertia' in manipulator.platform, expected an array of 3 or 6 numbers"},
        Refusal{"leg_point", "[[manipulator.leg]]\nbase_point = [0.0953, -1.9682, 0.0]", "@[[manipulator.leg]]",
                "missing key 'base_point' in manipulator.leg[2], expected an array of 3 numbers here or in "
                "manipulator.leg_defaults"},
        Refusal{"trajectory_key", "[trajectory]\nkind = \"helix\"\nduration = 3.0\n",
                "@[trajectory]\nkind = \"helix\"\n", "missing key 'duration' in trajectory, expected a number"}),
    nameOf);

/// The refusal of a marked text, without the file and place that it has to begin with.
std::string refusalAtMark(const std::string& text) {
  const MarkedText changed = marked(text);
  const std::string message = refusal<ScenarioError>([&] { parseScenario(changed.text, "a.toml"); });
  const std::string start = "a.toml:" + changed.place + ": error: ";
  return message.compare(0, start.size(), start) == 0 ? message.substr(start.size()) : message;
}

TEST(RefusedScenario, namesAMissingTable) {
  EXPECT_EQ(refusalAtMark("@name = \"x\"\n"), "missing key 'manipulator', expected a table");
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

INSTANTIATE_TEST_SUITE_P(
    Types, RefusedScenario,
    testing::Values(
        Refusal{"string_mass", "mass = 500.0", "mass = @\"500\"",
                "manipulator.platform.mass: a string, expected a number"},
        Refusal{"boolean_mass", "mass = 500.0", "mass = @true",
                "manipulator.platform.mass: a boolean, expected a number"},
        Refusal{"date_mass", "mass = 500.0", "mass = @2026-01-01",
                "manipulator.platform.mass: a date or time, expected a number"},
        Refusal{"nan_mass", "mass = 500.0", "mass = @nan", "manipulator.platform.mass: nan, expected a finite number"},
        Refusal{"inf_mass", "mass = 500.0", "mass = @-inf",
                "manipulator.platform.mass: -inf, expected a finite number"},
        Refusal{"short_vector", "[0.0, 0.0, 1.88]", "@[0.0, 1.88]",
                "manipulator.platform.center_of_mass: an array of 2, expected an array of 3 numbers"},
        Refusal{"scalar_vector", "[0.0, 0.0, 1.88]", "@1.88",
                "manipulator.platform.center_of_mass: a float, expected an array of 3 numbers"},
        Refusal{"nan_in_vector", "[0.0, 0.0, 1.88]", "[0.0, @nan, 1.88]",
                "manipulator.platform.center_of_mass[2]: nan, expected a finite number"},
        Refusal{"string_in_vector", "[0.0, 0.0, 1.88]", "[0.0, 0.0, @'x']",
                "manipulator.platform.center_of_mass[3]: a string, expected a number"},
        Refusal{"inertia_of_four", "[800.0, 810.0, 820.0]", "@[800.0, 810.0, 820.0, 0.0]",
                "manipulator.platform.inertia: an array of 4, expected an array of 3 or 6 numbers"},
        Refusal{"platform",
                "[manipulator.platform]\nmass = 500.0\ncenter_of_mass = [0.0, 0.0, 1.88]\n"
                "inertia = [800.0, 810.0, 820.0]\n",
                "platform = @5\n", "manipulator.platform: an integer, expected a table"},
        Refusal{"knee", "friction = {", "knee = @1\nfriction = {",
                "manipulator.leg_defaults.knee: an integer, expected 'positive' or 'negative'"},
        Refusal{
            "knee_word", "friction = {", "knee = @\"postive\"\nfriction = {",
            "manipulator.leg_defaults.knee: 'postive', expected 'positive' or 'negative', did you mean 'positive'?"}),
    nameOf);

}  // namespace
}  // namespace ursula
