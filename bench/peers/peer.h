#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/joint_variables.h"
#include "model/manipulator.h"
#include "model/open_tree.h"

namespace ursula::bench {

/// An engine that solves the machine's dynamics, used as an expert would: coordinates have the engine's own form,
/// nothing is computed twice, and its own Jacobians close the loops. It is built from raw parameters alone. Not
/// thread-safe.
class Peer {
 public:
  Peer() = default;
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// "MuJoCo".
  virtual std::string name() const = 0;
  /// "2.2.2".
  virtual std::string version() const = 0;

  /// The engine's coordinates for the joints' motion. Allocates at first.
  virtual void coordinates(const Motion<double>& motion, const JointMotion& joints, TreeCoordinates& out) const = 0;

  virtual bool hasInverse() const { return true; }
  virtual Vector6d inverseDynamics(const TreeCoordinates& at) = 0;
  /// [ω̇; p̈] under efforts; ignores accelerations in `at`.
  virtual Vector6d directDynamics(const TreeCoordinates& at, const Vector6d& efforts) = 0;

  /// The possible deviation of an engine whose direct dynamics are not exact by design.
  struct Deviation {
    Vector6d left_out = Vector6d::Zero();  ///< [ω̇; p̈] of a term that it leaves out, to first order
    Vector6d softness = Vector6d::Zero();  ///< bound on each component, because its constraints yield
  };
  virtual Deviation deviation(const TreeCoordinates&, const Vector6d& /*efforts*/) { return {}; }
};

/// Simbody: inverse by realize(Velocity), calcResidualForceIgnoringConstraints and calcGTranspose; direct by
/// realize(Acceleration) with its own constraints.
std::unique_ptr<Peer> makeSimbodyPeer(const Manipulator& manipulator);

/// MuJoCo: inverse by mj_rne, direct by mj_rne and mj_crb, both closed by mj_jacSite. Null in a build without it.
std::unique_ptr<Peer> makeMujocoPeer(const Manipulator& manipulator);

/// MuJoCo: direct by mj_forward with its own soft constraints, which leave out J̇ q̇; no inverse. Null in a build
/// without it.
std::unique_ptr<Peer> makeSoftMujocoPeer(const Manipulator& manipulator);

/// DART: inverse by computeInverseDynamics, direct by the same at rest and masses from its Jacobians and inertias, both
/// closed by its Jacobians. Throws std::invalid_argument unless the machine has six URS legs. Null in a build without
/// it.
std::unique_ptr<Peer> makeDartPeer(const Manipulator& manipulator);
/// False in a build without DART.
bool dartAvailable();

/// Returns the peers of this build.
std::vector<std::unique_ptr<Peer>> makePeers(const Manipulator& manipulator);
/// Returns the names of peers that this build lacks.
std::vector<std::string> missingPeers();

}  // namespace ursula::bench
