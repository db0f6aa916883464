#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What it takes to draw a machine along its motion, and what it was asked: points and directions only, so that legs
/// of any kind are drawn by the same code. Points are in m, in B, from `origin`.
struct Picture {
  using Track = std::vector<Vector3d>;  ///< one entry for each instant

  struct Link {
    Track from, to;
  };

  struct Joint {
    std::string name;         ///< what it is, for people: "universal joint", "pin", …
    Track at;                 ///< its point
    std::vector<Track> axes;  ///< unit vectors, the driven one first; empty for a ball
    bool driven = false;      ///< about or along the first axis; its effort counts positive the other way
    bool slides = false;      ///< along its only axis
  };

  struct Leg {
    std::string kind;
    std::vector<Link> links;       ///< from the base to the platform; a later one may begin within the one before
    std::vector<Joint> joints;     ///< the driven ones in the order of the motors
    std::vector<Link> rails = {};  ///< of a carriage: what it slides on
  };

  Vector3d origin = Vector3d::Zero();
  std::vector<double> t;
  std::vector<Leg> legs;
  Track p;                                ///< P, commanded
  std::vector<Eigen::Vector4d> q;         ///< orientation [w, x, y, z], commanded, continuous
  std::vector<Vector3d> platform_points;  ///< where the legs hold the platform, in M
  Scenario scenario;
};

/// The machine of `scenario` at these instants. Throws PoseError.
std::shared_ptr<const Picture> makePicture(const Scenario& scenario, const std::vector<double>& instants);

/// The machine of `result` along its time series, at no more instants than an eye can tell apart. Null where there is
/// nothing to draw.
std::shared_ptr<const Picture> pictureOf(const ValidationResult& result);

}  // namespace ursula
