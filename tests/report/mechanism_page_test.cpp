// The page, the terminal's text and the picture of a mechanism: motors have names, bodies move, and nothing speaks of
// what only a manipulator has. The four-bar is made up by hand.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/mechanism_picture.h"
#include "report/files/written_files.h"
#include "report/page/mechanism_drawing.h"
#include "report/page/plots.h"
#include "report/page/scenario_picture.h"
#include "report/page/sections.h"
#include "report/text/quantity.h"
#include "report/text/result_facts.h"
#include "report/text/terminal.h"
#include "tests/report/report_samples.h"

namespace ursula {
namespace {

using Json = nlohmann::json;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A crank of 1 m turns by a tenth of a turn and takes along a coupler that keeps its direction.
MechanismPicture fourBar() {
  MechanismPicture out;
  const Vector3d A(0, 0, 0), B(0, 0, 1), C(2, 0, 1), D(2, 0, 0), lifted(1, 0, 1.6);
  out.bodies = {{"ground", true, {A, D}, 2, {Vector3d::Zero()}, {{1, 0, 0, 0}}},
                {"crank", false, {A, B}, 2, {}, {}},
                {"coupler", false, {B, C, lifted}, 2, {}, {}},
                {"rocker", false, {D, C}, 2, {}, {}}};
  for (int k = 0; k <= 10; ++k) {
    const double angle = 0.06 * k;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
    const Eigen::Vector4d q(turn.w(), turn.x(), turn.y(), turn.z());
    out.t.push_back(0.2 * k);
    out.bodies[1].p.push_back(Vector3d::Zero()), out.bodies[1].q.push_back(q);
    out.bodies[2].p.push_back(turn * B - B), out.bodies[2].q.push_back({1, 0, 0, 0});
    out.bodies[3].p.push_back(D - turn * D), out.bodies[3].q.push_back(q);
  }
  const Vector3d y = Vector3d::UnitY();
  out.joints = {{"crank_hinge", JointKind::revolute, 0, 1, A, A, {y}, 0, false},
                {"coupler_hinge", JointKind::revolute, 1, 2, B, B, {y}, -1, false},
                {"tip", JointKind::ball, 2, 3, C, C, {}, -1, true},
                {"rocker_hinge", JointKind::revolute, 0, 3, D, D, {y}, -1, false}};
  out.motors = {{"crank_hinge", "Nm"}};
  out.output = 2;
  out.output_point = lifted;
  out.scenario_file = "fourbar.toml", out.model_file = "fourbar.xml", out.motion = "fourier";
  out.duration = 2, out.samples = 11, out.freedoms = 1, out.mass = 3;
  out.warnings = {"the <odd> mesh was left out"};
  out.assumptions = {"damping is that of the default class"};
  out.idle = {"rod"};
  return out;
}

/// `factor` scales the efforts that were given.
ValidationResult sampleOf(double factor) {
  ValidationResult out;
  out.scenario = "fourbar";
  out.kind = "mechanism";
  out.subject = {"given.csv", Formulation::external, CalledBy::torques};
  out.mechanism = std::make_shared<const MechanismPicture>(fourBar());
  std::vector<double> expected, given, limit, deviation;
  for (std::size_t k = 0; k < out.mechanism->t.size(); ++k) {
    expected.push_back(3 * std::cos(0.1 * static_cast<double>(k)));
    given.push_back(factor * expected.back());
    limit.push_back(1e-10);
    deviation.push_back(std::abs(given.back() - expected.back()));
  }
  out.timeseries.add("t_s", out.mechanism->t);
  out.timeseries.add("q_1_rad", out.mechanism->t);
  out.timeseries.add("qdot_1_rad_s", std::vector<double>(expected.size(), 1.0));
  for (const char* axis : {"x", "y", "z"}) out.timeseries.add(std::string("output_") + axis + "_m", expected);
  out.timeseries.add("tau_1_Nm", given);
  out.timeseries.add("simbody_tau_1_Nm", expected);
  out.timeseries.add("limit_tau_Nm", limit);
  const double off = std::abs(factor - 1) * 3;
  out.checks = {judged("torque.pointwise", off, 1e-10, "N m", "rounding", "efforts against Simbody"),
                judged("torque.twin", off, 1e-10, "N m", "rounding", "efforts against Simbody's other tree"),
                judged("invariance.labels", 0, 1e-10, "N m", "rounding", "")};
  out.verdict = overall(out.checks);
  return out;
}

/// What a reader sees: the page without its style, data and script, which come first and last.
std::string seen(const std::string& html) {
  const std::size_t from = html.find("</style>");
  return html.substr(from, html.find("<script", from) - from);
}

/// The same without tags, whose classes are the style's.
std::string wordsOf(const std::string& html) {
  std::string out;
  bool within = false;
  for (const char c : seen(html)) {
    if (c == '<') within = true;
    if (!within) out += c;
    if (c == '>') within = false, out += ' ';
  }
  return out;
}

Json dataOf(const std::string& html) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = html.find(begin) + begin.size();
  return Json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(MechanismPage, beginsWithTheWorstMotor) {
  const ValidationResult wrong = sampleOf(1.01);
  const std::string said = report::sentence(wrong);
  EXPECT_TRUE(contains(said, "crank_hinge was given ")) << said;
  EXPECT_TRUE(contains(said, "3.03 N·m where 3.00 N·m is expected") ||
              contains(said, "3.03\u00a0N·m where 3.00\u00a0N·m is expected"))
      << said;
  EXPECT_TRUE(contains(said, "(1\u00a0% of the largest)")) << said;
  EXPECT_FALSE(contains(report::sentence(sampleOf(1)), "crank_hinge")) << "of right efforts none is the worst";
}

/// The page of any machine: the motor's two curves and their difference are the first charts.
TEST(MechanismPage, drawsTheWorstMotorFirst) {
  const auto first = [](const ValidationResult& result) { return report::plots(result).front(); };
  const report::Plot plot = first(sampleOf(1.01));
  EXPECT_EQ(plot.title, "crank_hinge: given and expected effort");
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_EQ(plot.lines[0].label, "expected");
  EXPECT_EQ(first(test::externalSample()).group, report::PlotGroup::worst);
  EXPECT_NE(first(sampleOf(1)).group, report::PlotGroup::worst) << "of right efforts none is the worst";
}

/// Red where it tells something: a mark on each motor would not.
TEST(Marks, areOnWrongMotorsUnlessAllAre) {
  std::vector<report::MotorDeviation> motors(3);
  for (int k = 0; k < 3; ++k) motors[k].motor = k, motors[k].share = k == 1 ? 0.5 : 0.1;
  EXPECT_EQ(report::markedOf(motors), std::vector<int>{1});
  motors[1].right = true;
  EXPECT_EQ(report::markedOf(motors), (std::vector<int>{0, 2}));
  for (report::MotorDeviation& motor : motors) motor.right = true;
  EXPECT_TRUE(report::markedOf(motors).empty());
  EXPECT_FALSE(report::worstOf(motors).has_value());
}

/// Efforts that differ from two formulations by as much are one fact.
TEST(MechanismPage, hasOneRowForOneFact) {
  const std::string repeated =
      "<details class=\"repeated\"><summary>1 more finds the same: Simbody, another spanning tree<";
  const std::string html = seen(report::reportHtml(sampleOf(1.01), Place::alone));
  EXPECT_TRUE(contains(html, repeated));
  EXPECT_TRUE(contains(html, "<details class=\"check fail\" open>"));
  EXPECT_TRUE(contains(html.substr(html.find(repeated)), "<details class=\"check fail\">")) << "it is folded";
  ValidationResult two = sampleOf(1.01);
  two.checks[1].value *= 2;
  EXPECT_FALSE(contains(seen(report::reportHtml(two, Place::alone)), "the same: ")) << "two engines that differ";
}

TEST(Unbroken, keepsNumbersAndUnitsOnOneLine) {
  EXPECT_EQ(report::unbroken("at t = 0.3 s by 1.61e-06 m within 2 runs"),
            "at t\u00a0=\u00a00.3\u00a0s by 1.61\u00a0×\u00a010⁻⁶\u00a0m within 2 runs");
  EXPECT_EQ(report::unbroken("z 0 +- 1e-14 m/s^2 instead of -9.81, 5 m."),
            "z 0\u00a0±\u00a010⁻¹⁴\u00a0m/s² instead of −9.81, 5\u00a0m.");
  EXPECT_EQ(report::unbroken("leg 3 moves, a-1 stays, 2 samples"), "leg 3 moves, a-1 stays, 2 samples");
}

TEST(MechanismPage, namesMotorsAndSpeaksOfNoLegs) {
  const std::string html = seen(report::reportHtml(sampleOf(1.01), Place::alone));
  for (const char* part : {"<th scope=\"row\">crank_hinge</th>", "fourbar.xml", "coupler", "given.csv",
                           "the &lt;odd&gt; mesh was left out", "damping is that of the default class", "Held at rest"})
    EXPECT_TRUE(contains(html, part)) << part;
  const std::string words = wordsOf(report::reportHtml(sampleOf(1.01), Place::alone));
  for (const char* part : {"leg", "Leg", "platform", "Platform", "κ(B)", "Motor 1"})
    EXPECT_FALSE(contains(words, part)) << part;
  EXPECT_LT(html.find("Warning on reading"), html.find("Assumed on reading"));
}

/// The negative control: the same words are found where they belong.
TEST(MechanismPage, isNotThatOfAManipulator) {
  const std::string words = wordsOf(report::reportHtml(test::externalSample(), Place::alone));
  for (const char* part : {"leg", "platform", "Motor 1"}) EXPECT_TRUE(contains(words, part)) << part;
}

TEST(MechanismPage, hasBodiesThatMove) {
  const Json machine = dataOf(report::reportHtml(sampleOf(1.01), Place::alone))["machine"];
  ASSERT_EQ(machine["bodies"].size(), 4u);
  EXPECT_EQ(machine["bodies"][0]["p"].size(), 3u) << "the ground stands still";
  EXPECT_EQ(machine["bodies"][1]["q"].size(), 4 * machine["t"].size());
  EXPECT_EQ(machine["joints"][0]["motor"], 0);
  EXPECT_TRUE(machine["joints"][2]["closure"]);
  EXPECT_EQ(machine["wrong"], Json::array({0}));
  EXPECT_EQ(machine["efforts"].size(), machine["t"].size());
  EXPECT_EQ(dataOf(report::reportHtml(sampleOf(1), Place::alone))["machine"]["wrong"], Json::array());
}

TEST(MechanismText, namesMotors) {
  const std::string text = report::validationText(sampleOf(1.01), false);
  EXPECT_TRUE(contains(text, "\n  crank_hinge  0.03 N·m")) << text;
  EXPECT_TRUE(contains(report::quietText(sampleOf(1.01), false), "crank_hinge was given "));
  EXPECT_FALSE(contains(report::validationText(sampleOf(1), false), "crank_hinge"));
}

TEST(MechanismDrawing, showsEachBodyByItsJoints) {
  const MechanismPicture machine = fourBar();
  EXPECT_FALSE(report::shapeOf(machine.bodies[1]).plate);
  EXPECT_EQ(report::shapeOf(machine.bodies[1]).rods.size(), 1u);
  EXPECT_TRUE(report::shapeOf(machine.bodies[2]).plate) << "its mass centre is off the line of its joints";
  EXPECT_EQ(report::shapeOf(machine.bodies[2]).rods.size(), 3u);
  EXPECT_GT(std::abs(report::viewOf(machine).y()), 0.8) << "a flat machine is not seen from its edge";
  const std::string svg = picture(machine, "a < b");
  EXPECT_TRUE(contains(svg, "a &lt; b"));
  EXPECT_TRUE(contains(svg, ">crank_hinge</text>"));
  EXPECT_FALSE(contains(svg, ">tip</text>"));
}

/// Names one line apart but for rounding do not cover each other; the same place moves the later one down.
TEST(MechanismDrawing, namesMotorsAtNearlyTheSamePlace) {
  for (const double apart : {0.0, 1e-15, -1e-15, 1e-9, 0.1}) {
    MechanismPicture machine = fourBar();
    for (int k = 0; k < 4; ++k) {
      MechanismPicture::Joint more = machine.joints.front();
      more.name = "motor_" + std::to_string(k), more.motor = k + 1;
      more.at_child += Vector3d(0, 0, apart * (k + 1));
      machine.joints.push_back(more);
      machine.motors.push_back({more.name, "Nm"});
    }
    const std::string svg = picture(machine, "many");
    std::vector<double> heights;
    for (std::size_t at = svg.find("<text class=\"motor\""); at != std::string::npos;
         at = svg.find("<text class=\"motor\"", at + 1))
      heights.push_back(std::stod(svg.substr(svg.find(" y=\"", at) + 4)));
    ASSERT_EQ(heights.size(), 15u) << "five names in three views";
    for (auto view = heights.begin(); view != heights.end(); view += 5) {
      std::sort(view, view + 5);
      for (int k = 1; k < 5; ++k) EXPECT_GT(view[k] - view[k - 1], 14.8) << apart;
    }
  }
}

/// A sum of one line may round to less than a line: such a name was moved down for ever.
TEST(MechanismDrawing, movesNamesDownWhereverSumsRound) {
  MechanismPicture machine = fourBar();
  machine.joints.push_back(machine.joints.front());
  machine.joints.back().name = "second";
  machine.joints.back().motor = 1;
  machine.motors.push_back({"second", "Nm"});
  int rounded_down = 0;
  for (double top = 0; top < 300; top += 0.1) {
    const double y = top + 250;
    rounded_down += (y + 15) - y < 15 ? 1 : 0;
    const std::string svg = report::drawn(machine, report::viewOf(machine), {0, top, 400, 300});
    EXPECT_TRUE(contains(svg, ">second</text>"));
  }
  EXPECT_GT(rounded_down, 0) << "the tops have such sums";
}

/// The points that two bodies share stay together along the motion, so the drawing's poses are the machine's.
TEST(MechanismDrawing, keepsJointsTogether) {
  const MechanismPicture machine = fourBar();
  for (const MechanismPicture::Joint& joint : machine.joints)
    for (std::size_t k = 0; k < machine.t.size(); ++k)
      EXPECT_LT((report::placed(machine.bodies[joint.parent], joint.at_parent, k) -
                 report::placed(machine.bodies[joint.child], joint.at_child, k))
                    .norm(),
                1e-12)
          << joint.name;
}

}  // namespace
}  // namespace ursula
