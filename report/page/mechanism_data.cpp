#include <Eigen/Geometry>
#include <algorithm>

#include "report/page/mechanism_drawing.h"
#include "report/page/page_data.h"
#include "report/page/sections.h"
#include "report/page/tracks.h"

namespace ursula::report {
namespace {

using Scene = nlohmann::ordered_json;

Scene bodyScene(const MechanismPicture& picture, std::size_t b) {
  const MechanismPicture::Body& body = picture.bodies[b];
  const BodyShape shape = shapeOf(body);
  Scene points = Scene::array(), rods = Scene::array(), plate = Scene::array();
  for (const Vector3d& point : body.points)
    for (const double each : point) points.push_back(screenNumber(each));
  for (const auto& [from, to] : shape.rods) rods.push_back({from, to});
  for (const std::size_t k : shape.points)
    if (shape.plate) plate.push_back(k);
  return {{"name", body.name},  {"fixed", body.fixed}, {"output", b == picture.output},
          {"points", points},   {"rods", rods},        {"plate", plate},
          {"p", track(body.p)}, {"q", track(body.q)}};
}

Scene jointScene(const MechanismPicture::Joint& joint) {
  constexpr const char* kinds[] = {"fixed", "revolute", "prismatic", "universal", "ball", "free"};
  Scene axes = Scene::array();
  for (const Vector3d& axis : joint.axes) axes.push_back(screenNumbers({axis.x(), axis.y(), axis.z()}));
  const Vector3d &at = joint.at_parent, &on_child = joint.at_child;
  return {{"name", joint.name},
          {"kind", kinds[static_cast<std::size_t>(joint.kind)]},
          {"parent", joint.parent},
          {"child", joint.child},
          {"at", screenNumbers({at.x(), at.y(), at.z()})},
          {"onChild", screenNumbers({on_child.x(), on_child.y(), on_child.z()})},
          {"axes", axes},
          {"motor", joint.motor},
          {"closure", joint.closure}};
}

Scene effortsAlong(const MechanismPicture& picture, const ValidationResult& result) {
  const std::vector<double>* t = result.timeseries.find("t_s");
  if (t == nullptr || t->empty()) return Scene::array();
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < picture.motors.size(); ++k)
    columns.push_back("tau_" + std::to_string(k + 1) + "_" + picture.motors[k].unit);
  return track(AtInstants(result.timeseries, picture.t).vectors(columns));
}

}  // namespace

nlohmann::ordered_json machineJson(const MechanismPicture& picture, const ValidationResult& result) {
  Scene bodies = Scene::array(), joints = Scene::array(), wrong = Scene::array(), none = Scene::array();
  for (std::size_t b = 0; b < picture.bodies.size(); ++b) bodies.push_back(bodyScene(picture, b));
  for (const MechanismPicture::Joint& joint : picture.joints) joints.push_back(jointScene(joint));
  for (const int motor : markedOf(motorsOff(result))) wrong.push_back(motor);
  const MechanismPicture::Body& output = picture.bodies[picture.output];
  std::vector<Vector3d> path;
  for (std::size_t k = 0; k < output.p.size(); ++k) path.push_back(placed(output, picture.output_point, k));
  const Vector3d view = viewOf(picture);
  return {{"t", screenNumbers(picture.t)},
          {"view", screenNumbers({view.x(), view.y(), view.z()})},
          {"bodies", bodies},
          {"joints", joints},
          {"tracks", none},
          {"legs", none},
          {"p", track(path)},
          {"q", track(output.q)},
          {"hold", none},
          {"error", none},
          {"efforts", effortsAlong(picture, result)},
          {"onPlatform", none},
          {"onBase", none},
          {"weak", Scene()},
          {"wrong", wrong}};
}

}  // namespace ursula::report
