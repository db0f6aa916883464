#include "parts/view/view.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/scalar.h"
#include "model/instants.h"
#include "model/legs/leg_type.h"
#include "nocsolver/legs/fixed_frame.h"
#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/page/page_data.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/subject/motion_check.h"

namespace ursula {

extern const std::string_view view_script, view_sections_html, view_style_html;

namespace {

using Json = nlohmann::ordered_json;

constexpr int instants = 101;

template <class Vector>
Json numbers(const Vector& vector) {
  return std::vector<double>(vector.data(), vector.data() + vector.size());
}
Json rows(const Matrix3d& matrix) {
  Json out = Json::array();
  for (int i = 0; i < 3; ++i) out.push_back(numbers(Vector3d(matrix.row(i))));
  return out;
}
Json quaternion(const Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.w(), q.x(), q.y(), q.z()};
}

Json slider(const std::string& name, const char* unit, double from, double to) {
  return {{"name", name}, {"unit", unit}, {"from", from}, {"to", to}, {"value", from}};
}

Json legJson(const Leg& leg) {
  Matrix3d frame;
  Vector3d x, u, z;
  setFixedFrame(leg.base_axis, x, u, z);
  frame << x, u, z;
  return {{"kind", rowOf(leg.kind).name},
          {"base", numbers(leg.base_point)},
          {"point", numbers(leg.platform_point)},
          {"frame", rows(frame)},
          {"l", leg.proximal.length},
          {"s", leg.distal.length},
          {"side", leg.knee == Knee::positive ? 1 : -1},
          {"centers", {numbers(leg.proximalCenter()), numbers(leg.distalCenter())}},
          {"masses", {leg.proximal.mass, leg.distal.mass}}};
}

/// A history acts as it does at t = 0.
Json loadJson(const Load* load) {
  if (load == nullptr) return nullptr;
  const Wrench<double> wrench = load->at(0.0);
  return {{"on_platform", load->frame == Load::Frame::platform},
          {"force", numbers(wrench.force)},
          {"moment", numbers(wrench.moment)},
          {"point", numbers(load->point)}};
}

/// Units of a motor's coordinate and effort.
Json unitsOf(bool slides) { return slides ? Json{"m", "N"} : Json{"rad", "N·m"}; }

std::string page(const std::string& title, const std::string& sentence, const Json& data, bool legs) {
  report::Page out;
  out.kind = "Machine to move";
  out.title = title;
  out.sentence = sentence;
  out.sections = {{"machine", "Machine", report::rendered(view_sections_html, {{"legs", legs}})}};
  out.data = report::inScript(data);
  const std::string script = fmt::format("(() => {{\n{}}})();\n{}", view_script, report::report_script);
  out.script = script;
  out.style = view_style_html;
  return report::pageHtml(out);
}

struct PathJson {
  Json path = {{"t", Json::array()}, {"poses", Json::array()}};
  Vector3d low = Vector3d::Constant(1e300), high = -low;
};

PathJson pathOf(const Scenario& scenario) {
  PathJson out;
  for (const double t : equallySpaced(scenario.trajectory->duration(), instants)) {
    const Motion<double> at = scenario.trajectory->at(t);
    out.path["t"].push_back(t);
    out.path["poses"].push_back({{"p", numbers(at.p)}, {"q", quaternion(at.Q)}});
    out.low = out.low.cwiseMin(at.p);
    out.high = out.high.cwiseMax(at.p);
  }
  return out;
}

Json bodyJson(const MechanismBody& body) {
  return {{"name", body.name},
          {"fixed", body.fixed},
          {"mass", body.weightless ? 0 : body.mass},
          {"center", numbers(body.center_of_mass)}};
}

Json jointJson(const MechanismJoint& joint) {
  constexpr const char* kinds[] = {"fixed", "revolute", "prismatic", "universal", "ball", "free"};
  return {{"name", joint.name},
          {"kind", kinds[static_cast<std::size_t>(joint.kind)]},
          {"parent", joint.parent},
          {"child", joint.child},
          {"at", numbers(joint.centre)},
          {"onChild", numbers(joint.centre_of_child)},
          {"turn", rows(joint.turn)},
          {"axes", {numbers(joint.axis[0]), numbers(joint.axis[1])}},
          {"position", joint.position},
          {"stiffness", joint.kind == JointKind::revolute || joint.slides() ? joint.stiffness : 0},
          {"rest", joint.spring_reference}};
}

}  // namespace

std::string viewHtml(const Scenario& scenario) {
  tryMotion(scenario);
  const Manipulator& machine = *scenario.manipulator;
  Json legs = Json::array(), motors = Json::array(), names = Json::array(), units = Json::array(),
       sliders = Json::array();
  for (int i = 0; i < machine.legCount(); ++i) legs.push_back(legJson(machine.leg(i)));
  for (const Motor& motor : machine.motors()) {
    motors.push_back({{"leg", motor.leg}, {"joint", motor.joint}, {"turns", !motor.slides()}});
    names.push_back(fmt::format("leg {}, {}", motor.leg + 1, nameOf(motor.coordinate)));
    units.push_back(unitsOf(motor.slides()));
  }
  const PathJson along = pathOf(scenario);
  const Motion<double> start = scenario.trajectory->at(0);
  double length = 0;
  for (const Leg& leg : machine.parameters().legs)
    length = std::max(length, (start.p + start.Q * leg.platform_point - leg.base_point).norm());
  for (int k = 0; k < 3; ++k) sliders.push_back(slider({"xyz"[k]}, "m", along.low(k) - length, along.high(k) + length));
  for (const char* angle : {"roll", "pitch", "yaw"}) sliders.push_back(slider(angle, "°", -90, 90));
  const Json view = {
      {"machine",
       {{"legs", legs},
        {"motors", motors},
        {"motor_names", names},
        {"motor_units", units},
        {"gravity", numbers(machine.gravity())},
        {"platform", {{"mass", machine.platform().mass}, {"center", numbers(machine.platform().center_of_mass)}}},
        {"load", loadJson(scenario.load.get())},
        {"length", length}}},
      {"sliders", sliders},
      {"path", along.path}};
  return page(scenario.name, "Move the platform: legs, reach and the efforts that hold it at rest follow.",
              {{"view", view}}, true);
}

std::string viewHtml(const MechanismScenario& scenario) {
  const Mechanism& mechanism = *scenario.mechanism;
  const MechanismAlong along(scenario);
  Json bodies = Json::array(), joints = Json::array(), names = Json::array(), units = Json::array(),
       sliders = Json::array();
  for (const MechanismBody& body : mechanism.bodies()) bodies.push_back(bodyJson(body));
  for (const MechanismJoint& joint : mechanism.joints()) joints.push_back(jointJson(joint));
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) {
    const MechanismJoint& motor = mechanism.motor(k);
    const double unit = motor.slides() ? 1 : 180 / pi, free = motor.slides() ? mechanism.length() / 2 : pi;
    const double start = scenario.trajectory->at(0).q(static_cast<Eigen::Index>(k));
    sliders.push_back(slider(motor.name, motor.slides() ? "m" : "°",
                             unit * (std::isfinite(motor.lower) ? motor.lower : start - free),
                             unit * (std::isfinite(motor.upper) ? motor.upper : start + free)));
    names.push_back(motor.name);
    units.push_back(unitsOf(motor.slides()));
  }
  Json path = {{"t", Json::array()}, {"motors", Json::array()}, {"states", Json::array()}};
  LoopWork work;
  for (const double t : equallySpaced(scenario.trajectory->duration(), instants)) {
    static_cast<void>(along.motion().inverseDynamics(t, work));
    Json states = Json::array();
    for (const BodyState& body : work.bodies)
      states.push_back(
          {{"p", numbers(Vector3d(body.displacement.translation()))}, {"q", quaternion(body.displacement.linear())}});
    path["t"].push_back(t);
    path["motors"].push_back(numbers(scenario.trajectory->at(t).q));
    path["states"].push_back(states);
  }
  const auto picture = makePicture(scenario, along, instants);
  Json drawn = report::machineJson(*picture, {});
  drawn["path"] = drawn["p"];
  drawn["t"] = {0.0};
  for (Json& body : drawn["bodies"]) {
    body["p"] = {0.0, 0.0, 0.0};
    body["q"] = {1.0, 0.0, 0.0, 0.0};
  }
  drawn["p"] = {0.0, 0.0, 0.0};
  const Json view = {{"machine",
                      {{"bodies", bodies},
                       {"joints", joints},
                       {"motors", mechanism.motors()},
                       {"motor_names", names},
                       {"motor_units", units},
                       {"gravity", numbers(mechanism.gravity())},
                       {"output", mechanism.output()},
                       {"output_point", numbers(picture->output_point)},
                       {"length", mechanism.length()}}},
                     {"sliders", sliders},
                     {"path", path}};
  return page(scenario.name, "Move the motors: the loops, and the efforts that hold the machine at rest, follow.",
              {{"view", view}, {"machine", drawn}}, false);
}

}  // namespace ursula
