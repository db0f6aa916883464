// What each verb does with a scenario that has [mechanism]: direct, simulate, and the refusal of those that take none.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/csv.h"
#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

/// A call of the program on copies of tests/vectors/loops.
class MechanismVerbs : public testing::Test {
 protected:
  MechanismVerbs() {
    for (const std::string file : {"delta.toml", "delta.xml", "fourbar.toml", "fourbar.xml", "fourbar.sdf"})
      ursula_.write(file, TemporaryFolder::read(std::string(URSULA_VECTORS "/loops/") + file));
  }
  CsvTable read(const std::string& file) const { return readCsv(ursula_.folder() / file); }
  /// The largest difference of the columns that both tables have.
  static double largestDifference(const CsvTable& a, const CsvTable& b, std::size_t* common = nullptr) {
    double out = 0;
    EXPECT_EQ(a.rows(), b.rows());
    for (const std::string& name : a.names) {
      if (b.find(name) == nullptr) continue;
      if (common != nullptr) ++*common;
      for (std::size_t i = 0; i < std::min(a.rows(), b.rows()); ++i)
        out = std::max(out, std::abs(a.at(name)[i] - b.at(name)[i]));
    }
    return out;
  }

  const Program ursula_;
};

TEST_F(MechanismVerbs, thoseThatTakeNoneSaySoInOneWay) {
  ursula_.write("log.csv", "t_s,tau_1_Nm\n0,1\n");
  const std::string says =
      "delta.toml:2:1: error: mechanism: this verb takes a scenario with [manipulator], and this "
      "one has [mechanism], which check, validate, inverse, direct, simulate and sweep take";
  Refusals calls;
  for (const std::string call :
       {"map delta.toml", "poses delta.toml", "export delta.toml --format sdf", "excite delta.toml", "prove delta.toml",
        "identify delta.toml --measured log.csv", "init new.toml --from delta.toml --lengths mm"})
    calls.emplace_back(call, says);
  calls.emplace_back("inverse delta.toml --format binary", "--format: delta.toml has [mechanism]");
  calls.emplace_back("sweep delta.toml", "mechanism: a scenario, expected a sweep");
  expectRefused(ursula_, calls);
}

TEST_F(MechanismVerbs, aScenarioHasOneMachine) {
  const std::string delta = ursula_.read("delta.toml");
  ursula_.write("both.toml", delta + "[manipulator]\n");
  ursula_.write("none.toml", "name = \"none\"\n");
  for (const std::string verb : {"check", "validate", "inverse", "map"})
    expectRefused(ursula_, {{verb + " both.toml", "beside [manipulator], expected one of the two"},
                            {verb + " none.toml", "expected a table [manipulator] or [mechanism]"}});
}

TEST_F(MechanismVerbs, standardInputMayHaveAMechanism) {
  const UrsulaRun named = ursula_("inverse delta.toml --samples 3"),
                  piped = ursula_("inverse - --samples 3 <delta.toml");
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_EQ(piped.out, named.out);
}

TEST_F(MechanismVerbs, noOutputReplacesTheModel) {
  expectRefused(ursula_, {{"inverse delta.toml --out delta.xml", "delta.toml reads this file"},
                          {"simulate delta.toml --out delta.xml", "delta.toml reads this file"}});
}

TEST_F(MechanismVerbs, directFindsTheAssembliesOfTheMotion) {
  for (const std::string machine : {"delta", "fourbar"}) {
    ursula_.passing("inverse " + machine + ".toml --samples 21 --out motion.csv");
    ursula_.passing("direct " + machine + ".toml motion.csv --out found.csv");
    std::size_t common = 0;
    EXPECT_LT(largestDifference(read("found.csv"), read("motion.csv"), &common), 1e-13);
    EXPECT_EQ(common, read("found.csv").names.size() - 7) << "all but the output's pose";
    double norm = 0;
    for (const char* part : {"output_w", "output_x", "output_y", "output_z"})
      norm += std::pow(read("found.csv").at(part).back(), 2);
    EXPECT_NEAR(norm, 1, 1e-14);
    EXPECT_NE(read("found.csv").at("output_x_m").front(), read("found.csv").at("output_x_m")[5]);
  }
}

TEST_F(MechanismVerbs, directTakesJointsNamesAndNoTime) {
  ursula_.write("named.csv", "arm2_motor_rad,arm0_motor_rad,q_2_rad\n0.1,0.2,0.3\n");
  ursula_.write("numbered.csv", "q_1_rad,q_2_rad,q_3_rad\n0.2,0.3,0.1\n");
  const UrsulaRun named = ursula_.passing("direct delta.toml named.csv");
  EXPECT_EQ(named.out, ursula_("direct delta.toml numbered.csv").out);
  EXPECT_EQ(named.out.substr(0, 8), "q_1_rad,");
}

TEST_F(MechanismVerbs, directRefusesWithTheRowsPlace) {
  ursula_.write("far.csv", "q_1_rad,q_2_rad,q_3_rad\n0,0,0\n0.1,0,0\n9,0,0\n");
  ursula_.write("few.csv", "q_1_rad,q_2_rad\n0,0\n");
  ursula_.write("none.csv", "q_1_rad,q_2_rad,q_3_rad\n");
  expectRefused(ursula_, {{"direct delta.toml far.csv", "far.csv:4: error: the loops cannot follow the motors"},
                          {"direct delta.toml few.csv", "missing column 'q_3_rad'"},
                          {"direct delta.toml none.csv", "none.csv"},
                          {"direct delta.toml", "expected FILE.csv with the motors' coordinates"},
                          {"direct delta.toml far.csv --phi 1,2,3", "expected FILE.csv"},
                          {"direct " + helix + " far.csv", "has [manipulator], expected one pose"}});
}

TEST_F(MechanismVerbs, aModelInPlaceOfAScenarioIsToldWhatMakesOne) {
  ursula_.passing("export " + helix + " --format mjcf --out hexapod.xml");
  ursula_.write("page.xml", "<html></html>\n");
  const std::string is_model = ": error: this is a model, and a scenario is expected, which ursula ";
  Refusals calls;
  for (const std::string verb : {"validate", "check", "inverse", "map", "direct"}) {
    calls.emplace_back(verb + " delta.xml", "delta.xml" + is_model + "init my.toml --model delta.xml makes of it");
    calls.emplace_back(verb + " hexapod.xml",
                       "hexapod.xml" + is_model + "import hexapod.xml --out my.toml makes of it");
    calls.emplace_back(verb + " page.xml", "the root element is <html>");
  }
  expectRefused(ursula_, calls);
}

TEST_F(MechanismVerbs, importSaysWhereAnotherMachineGoes) {
  ursula_.passing("export " + helix + " --format mjcf --out hexapod.xml");
  expectRefused(ursula_, {{"import delta.xml", "As a machine of another kind: ursula init my.toml --model delta.xml"}});
  const UrsulaRun wrong = ursula_.ending(2, "import hexapod.xml --platform nobody");
  EXPECT_EQ(wrong.err.find("another kind"), std::string::npos) << wrong.err;
}

TEST_F(MechanismVerbs, importLeavesOutWhatItIsTold) {
  ursula_.passing("export " + helix + " --format mjcf --out hexapod.xml");
  std::string text = ursula_.read("hexapod.xml");
  const std::size_t hinge = text.find("type=\"hinge\"");
  ASSERT_NE(hinge, std::string::npos);
  ursula_.write("springs.xml", text.insert(hinge, "stiffness=\"3\" "));
  expectRefused(ursula_, {{"import springs.xml", "springs.xml"},
                          {"import springs.xml --leave-out sprigs", "--leave-out: 'sprigs', expected fluid"}});
  const UrsulaRun without = ursula_.passing("import springs.xml --leave-out springs");
  EXPECT_THAT(without.err, HasSubstr("Its spring is left out"));
}

TEST_F(MechanismVerbs, initWritesAScenarioThatPasses) {
  ursula_.passing("init 'my \"own\".toml' --model delta.xml");
  ursula_.passing("init fourbar_sdf.toml --model fourbar.sdf --motors crank_hinge");
  const UrsulaRun check = ursula_.passing("check 'my \"own\".toml' fourbar_sdf.toml");
  const UrsulaRun verdict = ursula_("validate 'my \"own\".toml' --quiet --out results");
  EXPECT_EQ(verdict.exit_code, 0) << verdict.out << verdict.err;
}

TEST_F(MechanismVerbs, initAsksForMotorsThatNobodyNames) {
  expectRefused(ursula_,
                {{"init new.toml --model fourbar.sdf",
                  "fourbar.sdf: it drives no joint, expected --motors A,B,…, one for its 1 freedom; candidates: "
                  "crank_hinge, knee, rocker_hinge"},
                 {"init new.toml --model fourbar.sdf --motors nobody", "--motors: 'nobody', no joint has that name"},
                 {"init new.toml --model fourbar.sdf --motors crank_hinge,knee", "2 motors for 1 freedom"},
                 {"init new.toml --motors knee", "--model"}});
}

TEST_F(MechanismVerbs, namesMayHaveQuotes) {
  std::string text = ursula_.read("fourbar.sdf");
  for (std::size_t at = 0; (at = text.find("\"crank_hinge\"", at)) != std::string::npos;)
    text.replace(at, 13, "'the \"crank\" \\ hinge'");
  ursula_.write("quoted.sdf", text);
  ursula_.passing("init new.toml --model quoted.sdf --motors 'the \"crank\" \\ hinge'");
  const UrsulaRun check = ursula_.passing("check new.toml");
}

TEST_F(MechanismVerbs, motorsAreNotEmpty) {
  std::string text = ursula_.read("fourbar.toml");
  ursula_.write("none.toml", text.replace(text.find("[\"crank_hinge\"]"), 15, "[]"));
  expectRefused(ursula_, {{"check none.toml", "none.toml:4:10: error: mechanism.motors: [], expected the names"}});
}

/// A sweep of two numbers of the model and one of the motion.
const std::string swept =
    "scenario = \"delta.toml\"\nwhat = \"inverse\"\ndesign = \"grid\"\nsamples = 11\n"
    "[[vary]]\nkey = \"mechanism.gravity.2\"\nvalues = [-9.81, -1.62]\n"
    "[[vary]]\nkey = \"mechanism.joint.arm0_motor.damping\"\nvalues = [0.0, 1.0]\n"
    "[[vary]]\nkey = \"trajectory.motors.1.sin.0\"\nvalues = [0.02, 0.03]\n";

TEST_F(MechanismVerbs, sweepFindsTheLargestEffortsOfItsPoints) {
  ursula_.write("sweep.toml", swept);
  const UrsulaRun run = ursula_.passing("sweep sweep.toml --db sweep.db");
  EXPECT_THAT(run.out, HasSubstr("8 points: 8 pass"));
  ursula_.passing("sweep report sweep.db --out page --csv rows.csv");
  std::set<double> found;
  const CsvTable rows =
      readCsv(ursula_.folder() / "rows.csv", {[](const std::string& name) { return name == "tau_1_Nm"; }});
  for (int i = 0; i < 8; ++i) {
    ursula_.write("point.toml", ursula_("sweep show sweep.toml " + std::to_string(i)).out);
    ursula_.passing("inverse point.toml --samples 11 --out point.csv");
    double largest = 0;
    const CsvTable point = read("point.csv");
    for (const double effort : point.at("tau_1_Nm")) largest = std::max(largest, std::abs(effort));
    EXPECT_DOUBLE_EQ(rows.at("tau_1_Nm")[static_cast<std::size_t>(i)], largest) << "point " << i;
    found.insert(largest);
  }
  EXPECT_EQ(found.size(), 8u) << "each number changes the efforts";
}

TEST_F(MechanismVerbs, sweepRefusesNumbersThatTheModelDoesNotHave) {
  const auto with = [](std::string text, const std::string& old, const std::string& now) {
    return text.replace(text.find(old), old.size(), now);
  };
  ursula_.write("a.toml", with(swept, "arm0_motor", "arm0_moter"));
  ursula_.write("b.toml", with(swept, "sin.0", "sine.0"));
  ursula_.write("d.toml", with(with(swept, "samples", "pointwise = true\nsamples"), "inverse", "validate"));
  const std::string delta = ursula_.read("delta.toml");
  ursula_.write("numbers.toml", delta + "[mechanism.numbers]\n\"body.nobody.mass\" = 1\n");
  expectRefused(ursula_,
                {{"sweep a.toml", "a.toml:9:7: error: 'joint.arm0_moter.damping', the model has no such number"},
                 {"sweep b.toml", "no key 'sine'"},
                 {"sweep d.toml", "pointwise: delta.toml has [mechanism]"},
                 {"check numbers.toml", "'body.nobody.mass', the model has no such number"}});
}

TEST_F(MechanismVerbs, numbersOfAScenarioAreThoseOfAnEditedModel) {
  std::string model = ursula_.read("fourbar.xml");
  const std::string old = "mass=\"1.2\" fullinertia=\"0.00813263066084988 ";
  ASSERT_NE(model.find(old), std::string::npos);
  ursula_.write("edited.xml", model.replace(model.find(old), old.size(), "mass=\"1.5\" fullinertia=\"0.0085 "));
  std::string text = ursula_.read("fourbar.toml");
  ursula_.write("numbers.toml",
                text + "[mechanism.numbers]\n\"body.crank.mass\" = 1.5\n\"body.crank.inertia.xx\" = 0.0085\n");
  ursula_.write("edited.toml", text.replace(text.find("fourbar.xml"), 11, "edited.xml"));
  for (const std::string name : {"numbers", "edited", "fourbar"})
    ursula_.passing("inverse " + name + ".toml --samples 5 --out " + name + ".csv");
  EXPECT_LT(largestDifference(read("numbers.csv"), read("edited.csv")), 1e-12);
  EXPECT_GT(largestDifference(read("numbers.csv"), read("fourbar.csv")), 1e-3);
}

class SimulateMechanism : public MechanismVerbs, public testing::WithParamInterface<std::string> {
 protected:
  UrsulaRun simulate(const std::string& rest) const { return ursula_("simulate --engine " + GetParam() + " " + rest); }
};

TEST_P(SimulateMechanism, theRightEffortsMakeTheMotion) {
  ursula_.passing("inverse delta.toml --samples 301 --out commanded.csv");
  const UrsulaRun run = simulate("delta.toml --out made.csv");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::size_t common = 0;
  EXPECT_LT(largestDifference(read("made.csv"), read("commanded.csv"), &common), 1e-9);
  EXPECT_EQ(common, 13u) << "t, q, qdot, qddot, tau";
  const std::vector<double> closure = read("made.csv").at("closure_m");
  EXPECT_LT(*std::max_element(closure.begin(), closure.end()), 1e-12);
  ursula_.passing("direct delta.toml commanded.csv --out poses.csv");
  EXPECT_LT(largestDifference(read("made.csv"), read("poses.csv")), 1e-9) << "the output body's pose";
}

TEST_P(SimulateMechanism, effortsOfAFileMakeItToo) {
  ursula_.passing("inverse fourbar.toml --samples 301 --out commanded.csv");
  const UrsulaRun run = simulate("fourbar.toml --torques commanded.csv --out made.csv");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("are ignored: q_1_rad"));
  EXPECT_NEAR(read("made.csv").at("q_1_rad").back(), read("commanded.csv").at("q_1_rad").back(), 1e-6);
}

TEST_P(SimulateMechanism, otherEffortsMakeAnotherMotion) {
  ursula_.passing("inverse delta.toml --samples 61 --out commanded.csv");
  const CsvTable right = read("commanded.csv");
  std::string text = "t_s,tau_1_Nm,tau_2_Nm,tau_3_Nm\n";
  for (std::size_t i = 0; i < 21; ++i) {
    text += std::to_string(right.at("t_s")[i]);
    for (int k = 1; k <= 3; ++k) text += "," + std::to_string(1.02 * right.at("tau_" + std::to_string(k) + "_Nm")[i]);
    text += "\n";
  }
  ursula_.write("wrong.csv", text);
  const UrsulaRun run = simulate("delta.toml --torques wrong.csv --out made.csv");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("of a motion from 0 to 2 s; the rest is not simulated"));
  EXPECT_EQ(read("made.csv").rows(), 21u);
  EXPECT_GT(std::abs(read("made.csv").at("q_1_rad").back() - right.at("q_1_rad")[20]), 1e-4);
}

TEST_P(SimulateMechanism, refusesWhatItCannotInterpolateOrRead) {
  ursula_.write("few.csv", "t_s,tau_1_Nm\n0,1\n1,1\n");
  ursula_.write("other.csv", "t_s,tau_2_Nm\n0,1\n1,1\n");
  expectRefused(ursula_, {{"simulate fourbar.toml --torques few.csv", "expected at least 6 to interpolate between"},
                          {"simulate fourbar.toml --torques other.csv", "missing column 'tau_1_Nm'"},
                          {"simulate " + helix, "--torques is required"}});
}

INSTANTIATE_TEST_SUITE_P(Engines, SimulateMechanism, testing::Values("noc", "simbody"),
                         [](const auto& engine) { return engine.param; });

}  // namespace
}  // namespace ursula
