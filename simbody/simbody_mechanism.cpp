#include "simbody/simbody_mechanism.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simbody/simbody_mechanism_internal.h"

namespace ursula {

SimbodyMechanism::SimbodyMechanism(const Mechanism& mechanism, Tree tree)
    : impl_(std::make_unique<Impl>(mechanism, tree)) {}
SimbodyMechanism::~SimbodyMechanism() = default;
SimbodyMechanism::SimbodyMechanism(SimbodyMechanism&&) noexcept = default;
SimbodyMechanism& SimbodyMechanism::operator=(SimbodyMechanism&&) noexcept = default;

void SimbodyMechanism::place(const MotorMotion& motion) {
  impl_->moveTo(motion.q, motion.t);
  impl_->setRates(motion);
}

void SimbodyMechanism::reset() {
  Impl& m = *impl_;
  m.state.setTime(0);
  m.state.updQ() = m.q_of_file;
  m.state.updU() = 0;
  m.u_dot = 0;
  m.rates.reset();
  for (const CoordinateInSimbody& c : m.coordinates) c.turns_near = 0;
  m.close();
}

double SimbodyMechanism::gap() const {
  double out = 0;
  for (const MechanismJoint& joint : impl_->mechanism.joints()) {
    const double angle = Eigen::AngleAxisd(joint.turn).angle();
    out = std::max({out, (joint.centre - joint.centre_of_child).norm(), angle * impl_->mechanism.length()});
  }
  return out;
}

Eigen::VectorXd SimbodyMechanism::motorCoordinates() const {
  impl_->realize(SimTK::Stage::Position);
  return impl_->motorValues();
}

Eigen::VectorXd SimbodyMechanism::motorRates() const {
  const Impl& m = *impl_;
  m.realize(SimTK::Stage::Velocity);
  Eigen::VectorXd out(m.motorCount());
  for (Eigen::Index k = 0; k < out.size(); ++k) out(k) = m.rate(m.coordinates[k]);
  return out;
}

SimbodyMechanism::Closure SimbodyMechanism::closure() const {
  const Impl& m = *impl_;
  m.realize(SimTK::Stage::Velocity);
  if (m.row_scale.size() == 0) return {};
  const Eigen::VectorXd rates = m.closureRows() * mapped(m.state.getU()).cwiseQuotient(m.column_scale);
  const double length = m.mechanism.length();
  return {m.closureErrors().cwiseAbs().maxCoeff() * length, rates.cwiseAbs().maxCoeff() * length};
}

int SimbodyMechanism::stateSize() const { return impl_->state.getNQ() + impl_->state.getNU(); }

std::vector<double> SimbodyMechanism::state() const {
  std::vector<double> y;
  y.reserve(stateSize());
  for (int i = 0; i < impl_->state.getNQ(); ++i) y.push_back(impl_->state.getQ()[i]);
  for (int i = 0; i < impl_->state.getNU(); ++i) y.push_back(impl_->state.getU()[i]);
  return y;
}

void SimbodyMechanism::setState(double t, const double* y) {
  Impl& m = *impl_;
  const int nq = m.state.getNQ(), nu = m.state.getNU();
  m.rates.reset();
  m.state.setTime(t);
  SimTK::Vector& q = m.state.updQ();
  for (int i = 0; i < nq; ++i) q[i] = y[i];
  SimTK::Vector& u = m.state.updU();
  for (int i = 0; i < nu; ++i) u[i] = y[nq + i];
}

void SimbodyMechanism::derivative(double t, const double* y, const Eigen::VectorXd& efforts, double* y_dot) try {
  setState(t, y);
  impl_->u_dot = impl_->simbodys_own ? impl_->byMultipliers(efforts) : impl_->eliminated(efforts);
  const SimTK::Vector& q_dot = impl_->state.getQDot();
  for (int i = 0; i < q_dot.size(); ++i) y_dot[i] = q_dot[i];
  for (int i = 0; i < impl_->u_dot.size(); ++i) y_dot[q_dot.size() + i] = impl_->u_dot[i];
} catch (const SimTK::Exception::Base&) {  // it asserts that masses are numbers
  std::fill_n(y_dot, stateSize(), std::nan(""));
}

void SimbodyMechanism::project() {
  Impl& m = *impl_;
  m.rates.reset();
  m.matter.normalizeQuaternions(m.state);
  m.close();
  const Eigen::MatrixXd G = m.closureRows();
  const Eigen::VectorXd u = mapped(m.state.getU()).cwiseQuotient(m.column_scale);
  const Eigen::VectorXd by = LeastSquares(G).solve(G * u);
  for (int i = 0; i < m.state.getNU(); ++i) m.state.updU()[i] -= by(i) * m.column_scale(i);
}

std::vector<std::size_t> SimbodyMechanism::cutJoints() const {
  std::vector<std::size_t> out;
  for (const std::size_t j : impl_->tree.cuts)
    if (impl_->mechanism.joints()[j].kind != JointKind::free) out.push_back(j);
  for (const SpanningTree::Gimbal& gimbal : impl_->tree.gimbals) {
    out.push_back(gimbal.first);
    out.push_back(gimbal.second);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string SimbodyMechanism::tree() const {
  const Impl& m = *impl_;
  const auto name = [&](std::size_t j) { return m.mechanism.joints()[j].name; };
  std::vector<std::string> cuts, free;
  for (const std::size_t j : m.tree.cuts)
    if (m.mechanism.joints()[j].kind != JointKind::free) cuts.push_back(name(j));
  for (const SpanningTree::Gimbal& gimbal : m.tree.gimbals)
    cuts.push_back(fmt::format("{} with {}", name(gimbal.first), name(gimbal.second)));
  for (const SpanningTree::Step& step : m.tree.steps)
    if (step.joint == SpanningTree::none) free.push_back(m.mechanism.bodies()[step.outboard].name);
  const auto listed = [](const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
    return out;
  };
  const std::string out = cuts.empty() ? "cuts no joint" : "cuts " + listed(cuts);
  return free.empty() ? out : fmt::format("{}; {} on six freedoms", out, listed(free));
}

}  // namespace ursula
