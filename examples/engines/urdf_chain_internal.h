#pragma once

// Efforts of a machine with closed loops by an engine that knows trees. The file's tree has all joints' coordinates q;
// its loops are cut. With the gaps g of the loops, the platform's frame x, G = ∂g/∂q and H = [G; ∂x/∂q], which is
// square,
//
//   H q̇ = [0; v; ω]                                                              (1)
//   H q̈ = [0; a; α] − Ḣq̇                                                         (2)
//   Gᵀλ + Sτ = M q̈ + bias + friction                                             (3)
//
// Rows of (3) without a motor give λ, those with one give τ. The engine gives H, Ḣq̇ and M q̈ + bias.

#include "examples/engines/solver_lines_internal.h"
#include "examples/engines/urdf_file_internal.h"

namespace closed_chain {

/// A point of a body and the body's axes, in the world. Six rows: linear, then angular.
struct Place {
  Eigen::Vector3d position;
  Eigen::Matrix3d axes;
  Eigen::MatrixXd jacobian;                  ///< of all coordinates
  Eigen::Matrix<double, 6, 1> acceleration;  ///< of the point itself: the second derivative of its position
};

/// What is asked of an engine. Coordinates and links are numbered as in the file.
class Engine {
 public:
  virtual ~Engine() = default;
  virtual void set(const Eigen::VectorXd& q, const Eigen::VectorXd& rates, const Eigen::VectorXd& accelerations) = 0;
  virtual Place place(int link, const Eigen::Vector3d& point) = 0;
  /// Inverse dynamics of the tree at what is set, with gravity, without friction and rotors.
  virtual Eigen::VectorXd forces() = 0;
};

class UrdfChain {
 public:
  UrdfChain(const UrdfFile& file, Engine& engine) : file_(file), engine_(engine), none_(zero(file.coordinates)) {
    if (gaps() + 6 < file.coordinates)
      throw std::runtime_error(
          "rods between two balls spin as they like, expected legs without; mujoco_solver takes them");
    if (gaps() + 6 != file.coordinates) throw std::runtime_error("expected as many gaps as leg coordinates");
  }

  /// In the order of the file's motors. Does not depend on earlier answers.
  Eigen::VectorXd efforts(const Motion& motion, Recipe recipe) {
    if (recipe == Recipe::inverse || recipe == Recipe::global_angular)
      throw std::runtime_error("this recipe is one of MuJoCo alone");
    const Eigen::VectorXd q = closedAt(motion);
    engine_.set(q, none_, none_);
    const Eigen::PartialPivLU<Eigen::MatrixXd> H(seen().H);
    Eigen::VectorXd task = zero(file_.coordinates);
    task.tail<6>() << motion.v, motion.w;
    const Eigen::VectorXd rates = H.solve(task);  // (1)
    engine_.set(q, rates, none_);
    task.tail<6>() << motion.a, motion.alpha;
    Eigen::VectorXd bias = seen().acceleration;
    if (recipe == Recipe::no_bias) bias.head(gaps()).setZero();
    task -= bias;
    const Eigen::VectorXd accelerations = H.solve(task);  // (2)
    engine_.set(q, rates, accelerations);
    const Eigen::VectorXd f = engine_.forces() + passive(rates, accelerations);
    return effortsOf(recipe, seen().H.topRows(gaps()), motorColumns(), f).motors;  // (3)
  }

 private:
  /// All gaps, then the platform's place.
  struct Seen {
    Eigen::VectorXd gap, acceleration;
    Eigen::MatrixXd H;
    Eigen::Vector3d p;
    Eigen::Matrix3d Q;
  };

  static Eigen::VectorXd zero(int size) { return Eigen::VectorXd::Zero(size); }
  int gaps() const { return 3 * static_cast<int>(file_.closures.size()); }

  Seen seen() {
    const int n = file_.coordinates;
    Seen out{zero(gaps()), zero(n), Eigen::MatrixXd(n, n), {}, {}};
    int row = 0;
    for (const UrdfClosure& closure : file_.closures) {
      const Place first = engine_.place(closure.body[0], closure.point[0]);
      const Place second = engine_.place(closure.body[1], closure.point[1]);
      out.gap.segment<3>(row) = first.position - second.position;
      out.acceleration.segment<3>(row) = (first.acceleration - second.acceleration).head<3>();
      out.H.middleRows<3>(row) = (first.jacobian - second.jacobian).topRows<3>();
      row += 3;
    }
    const Place platform = engine_.place(file_.platform, Eigen::Vector3d::Zero());
    out.acceleration.tail<6>() = platform.acceleration;
    out.H.bottomRows<6>() = platform.jacobian;
    out.p = platform.position;
    out.Q = platform.axes;
    return out;
  }

  /// Newton's method from the file's pose, in small steps. Throws where the loops do not close.
  Eigen::VectorXd closedAt(const Motion& motion) {
    Eigen::VectorXd q = none_;
    engine_.set(q, none_, none_);
    const Seen start = seen();
    const Eigen::Quaterniond turned(start.Q);
    constexpr int steps = 12;
    for (int step = 1; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      const Eigen::Quaterniond turn = step == steps ? motion.q : turned.slerp(share, motion.q);
      const Eigen::Vector3d p = start.p + share * (motion.p - start.p);
      for (int k = 0; k < (step == steps ? 6 : 2); ++k) q += correction(q, p, turn.toRotationMatrix());
    }
    engine_.set(q, none_, none_);
    if (!(seen().gap.cwiseAbs().maxCoeff() < 1e-9)) throw std::runtime_error("the loops cannot be closed at this pose");
    return q;
  }

  Eigen::VectorXd correction(const Eigen::VectorXd& q, const Eigen::Vector3d& p, const Eigen::Matrix3d& Q) {
    engine_.set(q, none_, none_);
    const Seen now = seen();
    Eigen::VectorXd missing(file_.coordinates);
    missing << -now.gap, p - now.p, turnOf(Q * now.Q.transpose());
    return now.H.partialPivLu().solve(missing);
  }

  /// Axis times angle of a small turn, to second order: exact where Newton's method ends.
  static Eigen::Vector3d turnOf(const Eigen::Matrix3d& R) {
    return 0.5 * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  }

  /// Dry friction is taken as sharp, and as none at rest.
  Eigen::VectorXd passive(const Eigen::VectorXd& rates, const Eigen::VectorXd& accelerations) const {
    Eigen::VectorXd out = none_;
    for (const UrdfJoint& joint : file_.joints) {
      if (joint.coordinate < 0) continue;
      const double rate = rates(joint.coordinate), sign = rate > 0 ? 1 : rate < 0 ? -1 : 0;
      out(joint.coordinate) =
          joint.damping * rate + joint.friction * sign + joint.rotor * accelerations(joint.coordinate);
    }
    return out;
  }

  Eigen::MatrixXd motorColumns() const {
    const auto motors = static_cast<Eigen::Index>(file_.motors.size());
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(file_.coordinates, motors);
    for (Eigen::Index k = 0; k < motors; ++k)
      S(file_.joints[static_cast<std::size_t>(file_.motors[static_cast<std::size_t>(k)])].coordinate, k) = 1;
    return S;
  }

  const UrdfFile& file_;
  Engine& engine_;
  Eigen::VectorXd none_;
};

/// The program of an engine: MODEL.urdf [RECIPE]. OfEngine is made of the file and gravity.
template <class OfEngine>
int answerByUrdf(int argc, char** argv) try {
  if (argc < 2) throw std::runtime_error(std::string("usage: ") + argv[0] + " MODEL.urdf [RECIPE]");
  const UrdfFile file(argv[1]);
  OfEngine engine(file, gravityOfScenario());
  UrdfChain chain(file, engine);
  answerAll(chain, recipeOf(argc > 2 ? argv[2] : "exact"));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}

}  // namespace closed_chain
