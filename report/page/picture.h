#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Everything needed to draw a machine along its motion, and the scenario. It holds only points and directions, so the
/// same code draws legs of any kind. Points are in m, in B, relative to `origin`.
struct Picture {
  using Track = std::vector<Vector3d>;  ///< one entry per instant

  struct Link {
    Track from, to;
  };

  struct Joint {
    std::string name;         ///< its name for people: "universal joint", "pin", …
    Track at;                 ///< its point
    std::vector<Track> axes;  ///< unit vectors, the driven one first; empty for a ball
    bool driven = false;  ///< by a motor about or along the first axis; positive efforts act in the opposite direction
    bool slides = false;  ///< along its only axis
  };

  struct Leg {
    std::string kind;
    std::vector<Link> links;       ///< from the base to the platform; a link may begin within the previous one
    std::vector<Joint> joints;     ///< the driven ones in the order of the motors
    std::vector<Link> rails = {};  ///< rails of a carriage
  };

  Vector3d origin = Vector3d::Zero();
  std::vector<double> t;
  std::vector<Leg> legs;
  Track p;                                ///< commanded P
  std::vector<Eigen::Vector4d> q;         ///< orientation [w, x, y, z], commanded, continuous
  std::vector<Vector3d> platform_points;  ///< the legs' points on the platform, in M
  Scenario scenario;
};

/// Returns the machine of `scenario` at these instants. Throws PoseError.
std::shared_ptr<const Picture> makePicture(const Scenario& scenario, const std::vector<double>& instants);

/// Returns the machine of `result` along its time series, at no more instants than are visible. Null if there is
/// nothing to draw.
std::shared_ptr<const Picture> pictureOf(const ValidationResult& result);

}  // namespace ursula
