#include <Eigen/Cholesky>

#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

Vector6d wrenchOf(const Mechanism& mechanism, const BodyState& state, const MechanismBody& body) {
  const Matrix3d R = state.displacement.linear(), I = R * body.inertia * R.transpose();
  const Vector3d omega = state.twist.head<3>(), alpha = state.twist_rate.head<3>(), a = state.twist_rate.tail<3>();
  Vector6d out;
  out << I * alpha + omega.cross(I * omega), body.mass * a;
  if (!body.weightless) out.tail<3>() -= body.mass * mechanism.gravity();
  return out;
}

/// One instant of the file's tree with its closures cut.
class OpenTree {
 public:
  OpenTree(const Mechanism& mechanism, const FileTree& tree) : mechanism_(mechanism), tree_(tree) {}

  /// The entries of the motors among all coordinates.
  VectorXd atMotors(const Instant& at, const VectorXd& all) const {
    VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(mechanism_.motorCount()));
    for (std::size_t k = 0; k < mechanism_.motorCount(); ++k)
      for (std::size_t c = 0; c < at.coordinates.size(); ++c)
        if (at.coordinates[c].joint == mechanism_.motors()[k])
          out(static_cast<Eigen::Index>(k)) = all(static_cast<Eigen::Index>(c));
    return out;
  }

  VectorXd forces(const Instant& at) const {
    VectorXd out = loadsOf(mechanism_, at);
    for (std::size_t b = 0; b < mechanism_.bodies().size(); ++b)
      out += tree_.jacobian(at, b).transpose() * wrenchOf(mechanism_, at.work.bodies[b], mechanism_.bodies()[b]);
    return out;
  }

  /// The same by M u̇ alone: without the products of velocities in the tree.
  VectorXd forcesOfAccelerations(const Instant& at) const {
    VectorXd out = loadsOf(mechanism_, at);
    const VectorXd u_dot = tree_.accelerations(at);
    for (std::size_t b = 0; b < mechanism_.bodies().size(); ++b) {
      const MatrixXd J = tree_.jacobian(at, b);
      BodyState state = at.work.bodies[b];
      state.twist.setZero();
      state.twist_rate = J * u_dot;
      out += J.transpose() * wrenchOf(mechanism_, state, mechanism_.bodies()[b]);
    }
    return out;
  }

  /// M of the tree.
  MatrixXd inertia(const Instant& at) const {
    const auto n = static_cast<Eigen::Index>(at.coordinates.size());
    MatrixXd out = MatrixXd::Zero(n, n);
    for (Eigen::Index c = 0; c < n; ++c) out(c, c) = mechanism_.joints()[at.coordinates[c].joint].rotor_inertia;
    for (std::size_t b = 0; b < mechanism_.bodies().size(); ++b) {
      const MatrixXd J = tree_.jacobian(at, b);
      const Matrix3d R = at.work.bodies[b].displacement.linear();
      out += J.topRows<3>().transpose() * (R * mechanism_.bodies()[b].inertia * R.transpose()) * J.topRows<3>();
      out += mechanism_.bodies()[b].mass * J.bottomRows<3>().transpose() * J.bottomRows<3>();
    }
    return out;
  }

  /// N of the tree's coordinates; rows of those that are cut are zero.
  MatrixXd complement(const Instant& at) const {
    MatrixXd out = MatrixXd::Zero(static_cast<Eigen::Index>(at.coordinates.size()),
                                  static_cast<Eigen::Index>(mechanism_.motorCount()));
    for (std::size_t c = 0; c < at.coordinates.size(); ++c)
      if (tree_.holds(at.coordinates[c].joint)) out.row(static_cast<Eigen::Index>(c)) = at.coordinates[c].row;
    return out;
  }

  /// Nᵀ f, with the ratios N of all joints' rates to the motors' at an instant.
  VectorXd byRatios(const Instant& at, const VectorXd& f) const {
    VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(mechanism_.motorCount()));
    for (std::size_t c = 0; c < at.coordinates.size(); ++c)
      out += at.coordinates[c].row.transpose() * f(static_cast<Eigen::Index>(c));
    return out;
  }

  /// What the part b of u̇ makes of the efforts, with or without rotors.
  VectorXd ofBias(const Instant& at, bool rotors) const {
    const VectorXd b = tree_.bias(at);
    VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(mechanism_.motorCount()));
    for (std::size_t i = 0; i < mechanism_.bodies().size(); ++i) {
      const Vector6d rate = tree_.jacobian(at, i) * b;
      const Matrix3d R = at.work.bodies[i].displacement.linear();
      Vector6d w;
      w << R * mechanism_.bodies()[i].inertia * R.transpose() * rate.head<3>(),
          mechanism_.bodies()[i].mass * rate.tail<3>();
      out += at.work.T[i].transpose() * w;
    }
    for (std::size_t c = 0; c < at.coordinates.size() && rotors; ++c)
      out += at.coordinates[c].row.transpose() * mechanism_.joints()[at.coordinates[c].joint].rotor_inertia *
             b(static_cast<Eigen::Index>(c));
    return out;
  }

  /// Gᵀ γ at the motors, for the velocity term γ of a closure's positions or turns.
  VectorXd ofGap(const Instant& at, std::size_t j, bool turns) const {
    const MechanismJoint& joint = mechanism_.joints()[j];
    const BodyState &A = at.work.bodies[joint.parent], &B = at.work.bodies[joint.child];
    const PointState on_parent = pointOf(A, joint.centre), on_child = pointOf(B, joint.centre_of_child);
    const MatrixXd G = tree_.jacobian(at, joint.child, on_child.x) - tree_.jacobian(at, joint.parent, on_parent.x);
    Vector6d gap;
    gap << B.twist_rate.head<3>() - A.twist_rate.head<3>(), on_child.a - on_parent.a;
    gap -= G * tree_.accelerations(at);
    if (turns) return atMotors(at, G.topRows<3>().transpose() * gap.head<3>());
    return atMotors(at, G.bottomRows<3>().transpose() * gap.tail<3>());
  }

 private:
  const Mechanism& mechanism_;
  const FileTree& tree_;
};

/// The loops left open, and forces in proportion to each gap's acceleration by velocities.
void addSoft(const EffortResidual& data, const OpenTree& open, const VectorXd& left_open, std::vector<Tried>& out) {
  std::vector<VectorXd> columns;
  for (std::size_t j = 0; j < data.mechanism->joints().size(); ++j) {
    const MechanismJoint& joint = data.mechanism->joints()[j];
    if (!joint.closure) continue;
    if (joint.kind != JointKind::ball && joint.kind != JointKind::fixed) return;  // not MuJoCo's
    for (const bool turns : {false, true}) {
      if (turns && joint.kind == JointKind::ball) continue;
      columns.push_back(-data.each([&](const Instant& at) { return open.ofGap(at, j, turns); }));
      if (columns.back().norm() <= 1e-9 * data.noc.norm()) columns.pop_back();
    }
  }
  if (columns.empty()) return;
  MatrixXd of(data.noc.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) of.col(static_cast<Eigen::Index>(c)) = columns[c];
  Tried tried{{CauseKind::closure, "soft", "all"},
              [of, left_open](const EffortResidual&, const VectorXd& x) { return VectorXd(left_open + of * x); },
              VectorXd::Ones(of.cols())};
  tried.finish = [](const VectorXd& x, const VectorXd& uncertainty, NamedCause&) {
    return (x.array() > -uncertainty.array()).all();
  };
  out.push_back(tried);
}

}  // namespace

void addClosureCauses(const EffortResidual& data, std::vector<Tried>& out) {
  const FileTree tree(*data.mechanism);
  if (!tree.isWhole()) return;
  const OpenTree open(*data.mechanism, tree);
  const auto change = [&](const auto& of) {
    VectorXd all = data.each(of);
    return VectorXd(all - data.noc);
  };
  const VectorXd left_open = change([&](const Instant& at) { return open.atMotors(at, open.forces(at)); });
  addFixed(out, {CauseKind::closure, "open"}, left_open);
  for (const bool rotors : {true, false})
    addFixed(out, {CauseKind::closure, "bias"},
             VectorXd(-data.each([&](const Instant& at) { return open.ofBias(at, rotors); })),
             rotors ? "" : "but for the rotors");
  Eigen::Index i = 0;
  const auto right = [&] { return data.noc.segment(data.motors * i++, data.motors); };
  addFixed(out, {CauseKind::closure, "least_squares"}, change([&](const Instant& at) {
             const MatrixXd N = open.complement(at);
             return open.atMotors(at, N * (N.transpose() * N).ldlt().solve(right()));
           }),
           "of least norm");
  i = 0;
  addFixed(out, {CauseKind::closure, "least_squares"}, change([&](const Instant& at) {
             const MatrixXd N = open.complement(at), MN = open.inertia(at) * N;
             return open.atMotors(at, MN * (N.transpose() * MN).ldlt().solve(right()));
           }),
           "weighted by the inverse of the tree's mass matrix");
  addFixed(out, {CauseKind::closure, "constant"},
           change([&](const Instant& at) { return open.byRatios(data.instants.front(), open.forces(at)); }));
  addFixed(out, {CauseKind::missing_term, "coriolis", "all"},
           change([&](const Instant& at) { return open.byRatios(at, open.forcesOfAccelerations(at)); }),
           "in the tree; the joints' accelerations are right");
  addSoft(data, open, left_open, out);
}

}  // namespace ursula::mechanisms
