#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/mechanism.h"

namespace ursula {

/// All that is needed to draw a mechanism along its motion and to say what was read: points and poses alone. Points are
/// those of the reference pose, in the world, m; a body's pose takes them to where they are at an instant.
struct MechanismPicture {
  struct Body {
    std::string name;
    bool fixed = false;
    std::vector<Vector3d> points;    ///< its joints' points, without repetition, then its mass centre if it has one
    std::size_t anchors = 0;         ///< number of the joints' points
    std::vector<Vector3d> p;         ///< displacement from the reference pose at each instant; one if it stands still
    std::vector<Eigen::Vector4d> q;  ///< its rotation [w, x, y, z], continuous; as many
  };

  struct Joint {
    std::string name;
    JointKind kind = JointKind::fixed;
    std::size_t parent = 0, child = 0;  ///< indices into bodies
    Vector3d at_parent = Vector3d::Zero(), at_child = Vector3d::Zero();
    std::vector<Vector3d> axes;  ///< unit vectors; the first goes with the parent, a second with the child
    int motor = -1;              ///< index into motors; −1 for none
    bool closure = false;
  };

  struct Motor {
    std::string name, unit;  ///< unit of its efforts as in columns, "Nm" or "N"
  };

  std::vector<double> t;  ///< s
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Motor> motors;                 ///< in the order of efforts
  std::size_t output = 0;                    ///< index into bodies
  Vector3d output_point = Vector3d::Zero();  ///< origin of the output body's frame, whose path is shown

  std::string scenario_file, model_file;  ///< names without folders
  std::string motion;                     ///< kind of the motors' motion
  double duration = 0;                    ///< s
  int samples = 0;                        ///< number of judged instants that the scenario asks for
  Vector3d gravity = Vector3d::Zero();    ///< m/s²
  double mass = 0;                        ///< of all moving bodies, kg
  int freedoms = 0;
  std::vector<std::string> idle;                   ///< bodies held at rest about their own line
  std::vector<std::string> warnings, assumptions;  ///< of reading the model
  std::string options;                             ///< of the command line that judges so again: "--rtol 0.01"
};

}  // namespace ursula
