// Asks Simbody for efforts of a mechanism as its users do, on the tree that cuts the file's closures.

#include <Eigen/Cholesky>
#include <stdexcept>

#include "parts/engines/closed_mechanism.h"
#include "parts/engines/loop_engine.h"
#include "simbody/simbody_mechanism.h"

namespace ursula {
namespace {

class SimbodyMechanismCalls : public MechanismCalls {
 public:
  explicit SimbodyMechanismCalls(const Mechanism& mechanism)
      : mechanism_(mechanism), loop_(mechanism_, SimbodyMechanism::Tree::of_file) {}

  Eigen::VectorXd efforts(Recipe recipe, const MotorMotion& motion) override {
    loop_.place(motion);
    if (recipe == Recipe::exact) return loop_.inverseDynamics();
    const auto [N, S, u_dot] = loop_.openTree();
    if (recipe == Recipe::no_bias) return N.transpose() * loop_.residual(N * motion.qddot);
    const Eigen::VectorXd f = loop_.residual(u_dot);
    if (recipe == Recipe::least_squares) return (N.transpose() * N).llt().solve(N.transpose() * f);
    if (recipe != Recipe::open) throw std::domain_error("it has no inverse dynamics of closed loops");
    for (Eigen::Index k = 0; k < S.rows(); ++k)
      if ((S.row(k).array() != 0).count() != 1)
        throw std::domain_error(mechanism_.motor(k).name + " is no coordinate of its own");
    return S * f;
  }

  double gap() const override { return loop_.closure().position; }
  std::vector<std::size_t> cutJoints() const override { return loop_.cutJoints(); }

 private:
  Mechanism mechanism_;
  SimbodyMechanism loop_;
};

}  // namespace

std::unique_ptr<MechanismCalls> makeSimbodyMechanism(const Mechanism& mechanism) {
  return std::make_unique<SimbodyMechanismCalls>(mechanism);
}

}  // namespace ursula
