#include "validation/limits/solver_rounding.h"

#include <cstring>
#include <functional>
#include <random>
#include <utility>

#include "nocsolver/noc/noc.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Number of different changes of the inputs.
constexpr unsigned moves = 8;

/// Changes numbers by one rounding, up or down, fixed by the seed. Zeros stay zero, and numbers of equal size stay
/// equal. Otherwise only some evaluations would take the branches for equal numbers.
class Mover {
 public:
  explicit Mover(unsigned seed) : seed_(seed) {}

  void operator()(double& number) const {
    std::uint64_t bits = 0;
    const double size = std::abs(number);
    std::memcpy(&bits, &size, sizeof bits);
    std::minstd_rand draw(static_cast<unsigned>(std::hash<std::uint64_t>()(bits) % 1000000007U) + seed_);
    draw.discard(2);
    number *= 1 + ((draw() & 1U) != 0 ? 1 : -1) * Eigen::NumTraits<double>::epsilon();
  }
  template <class Derived>
  void operator()(Eigen::MatrixBase<Derived>& of) const {
    for (Eigen::Index k = 0; k < of.size(); ++k) (*this)(of(k % of.rows(), k / of.rows()));
  }
  void operator()(std::array<double, 3>& numbers) const {
    for (double& number : numbers) (*this)(number);
  }

 private:
  unsigned seed_;
};

MachineParameters<double> moved(const Manipulator& manipulator, unsigned seed) {
  MachineParameters<double> machine(manipulator);
  const Mover move(seed);
  for (int i = 0; i < machine.legs_in_all; ++i) {
    LegModel<double>& leg = machine.legs[static_cast<std::size_t>(i)];
    for (Vector3d* vector : {&leg.a, &leg.b, &leg.x_hat, &leg.u, &leg.z_hat}) move(*vector);
    for (double* number : {&leg.l, &leg.s, &leg.rho, &leg.sigma, &leg.mass_1, &leg.mass_2}) move(*number);
    for (Matrix3d* tensor : {&leg.I_1, &leg.I_2}) move(*tensor);
    for (std::array<double, 3>* numbers : {&leg.viscous, &leg.coulomb, &leg.speed, &leg.rotor}) move(*numbers);
    for (Vector3d* off : {&leg.off_1, &leg.off_2}) move(*off);
  }
  move(machine.gravity);
  move(machine.mass);
  move(machine.rho);
  move(machine.I_M);
  return machine;
}

Motion<double> moved(Motion<double> motion, unsigned seed) {
  const Mover move(seed);
  for (Vector3d* vector : {&motion.p, &motion.omega, &motion.p_dot, &motion.omega_dot, &motion.p_ddot}) move(*vector);
  for (int k = 0; k < 3; ++k) {
    Vector3d axis = motion.Q.col(k);
    move(axis);
    motion.Q.col(k) = axis;
  }
  return motion;
}

}  // namespace

struct SolverRounding::Formulations {
  Subject as_they_are;
  std::vector<Subject> moved;
};

SolverRounding::SolverRounding(const Manipulator& machine, std::shared_ptr<const Load> load)
    : formulations_(std::make_unique<Formulations>(Formulations{nocSubject(machine, load), {}})) {
  for (unsigned k = 0; k < moves; ++k) formulations_->moved.push_back(nocSubject(moved(machine, k + 1), load));
}
SolverRounding::~SolverRounding() = default;
SolverRounding::SolverRounding(SolverRounding&&) noexcept = default;

Vector6d SolverRounding::torques(const Motion<double>& motion) { return formulations_->as_they_are.torques(motion); }

std::vector<SolverView> SolverRounding::at(const Motion<double>& motion, const Vector6d& others) {
  std::vector<SolverView> out;
  const auto add = [&](const Subject& of, const Motion<double>& m) {
    const KinematicAnswer kinematics = of.kinematics(m);
    out.push_back({kinematics.joints, kinematics.bodies, kinematics.T, kinematics.T_rate, of.torques(m),
                   of.accelerations(m, others), of.reactions(m)});
  };
  add(formulations_->as_they_are, motion);
  for (unsigned k = 0; k < moves; ++k) add(formulations_->moved[k], moved(motion, moves + 1 + k));
  return out;
}

}  // namespace ursula
