#include "validation/limits/solver_rounding.h"

#include <utility>

#include "nocsolver/noc/noc.h"
#include "validation/limits/moved_inputs.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Number of different changes of the inputs.
constexpr unsigned moves = 8;

/// Moves the numbers that the solver has read, and so also those of axes of length one.
MachineParameters<double> movedNumbers(const Manipulator& manipulator, unsigned seed) {
  MachineParameters<double> machine(manipulator);
  const Mover move(seed);
  for (int i = 0; i < machine.legs_in_all; ++i) {
    LegModel<double>& leg = machine.legs[i];
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

}  // namespace

struct SolverRounding::Formulations {
  Subject as_they_are;
  std::vector<Subject> moved;
};

SolverRounding::SolverRounding(const Manipulator& machine, std::shared_ptr<const Load> load,
                               const std::function<Subject(const Subject&)>& fault)
    : formulations_(std::make_unique<Formulations>()) {
  const auto faulty = [&fault](Subject right) { return fault ? fault(right) : right; };
  formulations_->as_they_are = faulty(nocSubject(machine, load));
  for (unsigned k = 0; k < moves; ++k)
    formulations_->moved.push_back(faulty(nocSubject(movedNumbers(machine, k + 1), load)));
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
