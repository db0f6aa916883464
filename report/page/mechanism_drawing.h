#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "model/mechanism_picture.h"

namespace ursula::report {

/// What stands for a body in a picture: rods between its points, and a plate if they lie in no line.
struct BodyShape {
  std::vector<std::size_t> points;  ///< those that are drawn: of plates in the order of the outline
  std::vector<std::pair<std::size_t, std::size_t>> rods;
  bool plate = false;
};
BodyShape shapeOf(const MechanismPicture::Body& body);

/// Returns where a body's point is at an instant.
Vector3d placed(const MechanismPicture::Body& body, const Vector3d& point, std::size_t instant);

/// Returns a direction to look along, from which a flat machine is not seen from its edge. Unit vector.
Vector3d viewOf(const MechanismPicture& picture);

/// Part of a drawing's sheet, px.
struct DrawingArea {
  double left = 0, top = 0, width = 0, height = 0;
};
/// Returns SVG elements: the machine at the start of its motion, seen along `forward`, with the output's path and the
/// motors' names; `wrong` are the motors to be marked. Classes: base, link c0 to c6, platform, rail, joint, driven,
/// path, motor, wrong; thin and plate.
std::string drawn(const MechanismPicture& picture, const Vector3d& forward, const DrawingArea& area,
                  const std::vector<bool>& wrong = {});
/// Returns how many px a metre has there.
double scaleOf(const MechanismPicture& picture, const Vector3d& forward, const DrawingArea& area);

}  // namespace ursula::report
