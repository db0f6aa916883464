// ODE's frames are at the mass centres and have the axes of the scenario's frames.

#include "parts/engines/ode/ode_machine_internal.h"

#include <stdexcept>

namespace ursula::ode_engine {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }
Vector3d vectorOf(const dReal* v) { return {v[0], v[1], v[2]}; }
Vector3d omegaOf(dBodyID body) {
  return body == nullptr ? Vector3d(Vector3d::Zero()) : vectorOf(dBodyGetAngularVel(body));
}
Vector3d centerOf(dBodyID body) { return vectorOf(dBodyGetPosition(body)); }
Matrix3d axesOf(dBodyID body) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(dBodyGetRotation(body)).leftCols<3>();
}
Vector3d velocityAt(dBodyID body, const Vector3d& point) {
  if (body == nullptr) return Vector3d::Zero();
  return vectorOf(dBodyGetLinearVel(body)) + omegaOf(body).cross(point - centerOf(body));
}

template <class Getter>
Vector3d readBy(Getter getter, dJointID joint) {
  dVector3 out;
  getter(joint, out);
  return vectorOf(out);
}

/// ODE has its own state for each thread.
void initialize() {
  static const int done = dInitODE2(0);
  if (done == 0 || dAllocateODEDataForThread(dAllocateMaskAll) == 0) throw std::runtime_error("ODE cannot start");
}

}  // namespace

OdeMachine::OdeMachine(const Manipulator& from, const Motion<double>& motion, Loops loops, const Softness& softness)
    : EngineMachine(from, from.platform().center_of_mass),
      joints_(at(from.legCount())),
      feedback_(at(from.legCount())),
      states_(at(from.legCount())) {
  initialize();
  world_.reset(dWorldCreate());
  dWorldSetGravity(world_.get(), from.gravity().x(), from.gravity().y(), from.gravity().z());
  dWorldSetERP(world_.get(), softness.erp);  // joints take these values when they are made
  dWorldSetCFM(world_.get(), softness.cfm);
  for (int i = 0; i < from.legCount(); ++i) {
    chains_.push_back(chainOf(from.leg(i)));
    for (std::size_t b = 0; b < 2; ++b)
      bodies_.push_back(
          bodyOf(chains_.back().links[b].mass, chains_.back().centers[b], chains_.back().links[b].inertia));
  }
  bodies_.push_back(bodyOf(from.platform().mass, from.platform().center_of_mass, from.platform().inertia));
  set(motion, true);
  for (int i = 0; i < from.legCount(); ++i) addLeg(i);
  for (int i = 0; loops == Loops::closed && i < from.legCount(); ++i) {
    const dJointID ball = dJointCreateBall(world_.get(), nullptr);
    dJointAttach(ball, bodies_[at(2 * i + 1)].id, platform().id);
    const Vector3d& tip = states_[at(i)].at.tip;
    dJointSetBallAnchor(ball, tip.x(), tip.y(), tip.z());
  }
}

OdeMachine::Body OdeMachine::bodyOf(double mass, const Vector3d& center, const Matrix3d& inertia) {
  if (!(mass > 0) || !(inertia.llt().info() == Eigen::Success))
    throw std::runtime_error("every body needs mass and inertia about every axis");
  dMass of;
  dMassSetParameters(&of, mass, 0, 0, 0, inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2),
                     inertia(1, 2));
  const Body out{dBodyCreate(world_.get()), center, mass, inertia};
  dBodySetMass(out.id, &of);
  return out;
}

void OdeMachine::setBody(const Body& body, const ChainBody& state) {
  const Vector3d c = state.frame * body.center, v = state.velocityOf(c);
  dMatrix3 R = {};
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(R).leftCols<3>() = state.frame.linear();
  dBodySetRotation(body.id, R);
  dBodySetPosition(body.id, c.x(), c.y(), c.z());
  dBodySetLinearVel(body.id, v.x(), v.y(), v.z());
  dBodySetAngularVel(body.id, state.omega.x(), state.omega.y(), state.omega.z());
}

/// Each link has one joint: a hinge or slider for one coordinate, a universal for two.
void OdeMachine::addLeg(int index) {
  const LegChain& chain = chains_[at(index)];
  const PlacedChain& placed = states_[at(index)].at;
  for (std::size_t b = 0; b < 2; ++b) {
    const int link = static_cast<int>(b), j = chain.firstOf(link), count = chain.jointsOf(link);
    const Vector3d &first = placed.axes[at(j)], &last = placed.axes[at(j + count - 1)], &c = placed.anchors[at(j)];
    const auto join = [&](dJointID joint) {
      dJointAttach(joint, bodies_[at(2 * index) + b].id, b == 0 ? nullptr : bodies_[at(2 * index)].id);
      dJointSetFeedback(joint, &feedback_[at(index)][b]);
      return joints_[at(index)][b] = joint;
    };
    if (count == 2) {
      const dJointID joint = join(dJointCreateUniversal(world_.get(), nullptr));
      dJointSetUniversalAnchor(joint, c.x(), c.y(), c.z());
      dJointSetUniversalAxis1(joint, last.x(), last.y(), last.z());
      dJointSetUniversalAxis2(joint, first.x(), first.y(), first.z());
    } else if (chain.slides(j)) {
      dJointSetSliderAxis(join(dJointCreateSlider(world_.get(), nullptr)), first.x(), first.y(), first.z());
    } else {
      const dJointID joint = join(dJointCreateHinge(world_.get(), nullptr));
      dJointSetHingeAnchor(joint, c.x(), c.y(), c.z());
      dJointSetHingeAxis(joint, first.x(), first.y(), first.z());
    }
  }
}

void OdeMachine::set(const Motion<double>& motion, bool with_bias) {
  for (int i = 0; i < manipulator.legCount(); ++i) {
    states_[at(i)] = legState(chains_[at(i)], manipulator.leg(i), i, motion, with_bias);
    for (std::size_t b = 0; b < 2; ++b) setBody(bodies_[at(2 * i) + b], states_[at(i)].bodies[b]);
  }
  platform_state_ = platformOf(motion);
  setBody(platform(), platform_state_);
}

void OdeMachine::goBack(double h) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const ChainBody& state = k + 1 == bodies_.size() ? platform_state_ : states_[k / 2].bodies[k % 2];
    const Vector3d v = vectorOf(dBodyGetLinearVel(bodies_[k].id)) - h * state.accelerationOf(centerOf(bodies_[k].id));
    const Vector3d omega = omegaOf(bodies_[k].id) - h * state.alpha;
    dBodySetLinearVel(bodies_[k].id, v.x(), v.y(), v.z());
    dBodySetAngularVel(bodies_[k].id, omega.x(), omega.y(), omega.z());
  }
}

OdeMachine::Place OdeMachine::placeOf(int leg, int j) const {
  const LegChain& chain = chains_[at(leg)];
  const std::size_t b = at(chain.linkOf(j));
  const dJointID joint = joints_[at(leg)][b];
  return {joint, dJointGetType(joint), j > chain.firstOf(chain.linkOf(j)), bodies_[at(2 * leg) + b].id,
          b == 0 ? nullptr : bodies_[at(2 * leg)].id};
}

Vector3d OdeMachine::axis(int leg, int j) const {
  const Place place = placeOf(leg, j);
  if (place.type == dJointTypeSlider) return readBy(dJointGetSliderAxis, place.joint);
  if (place.type == dJointTypeHinge) return readBy(dJointGetHingeAxis, place.joint);
  return readBy(place.outer ? dJointGetUniversalAxis1 : dJointGetUniversalAxis2, place.joint);
}

Vector3d OdeMachine::anchor(int leg, int j) const {
  const Place place = placeOf(leg, j);
  if (place.type == dJointTypeSlider) return centerOf(place.child);
  return readBy(place.type == dJointTypeHinge ? dJointGetHingeAnchor : dJointGetUniversalAnchor, place.joint);
}

double OdeMachine::coordinate(int leg, int j) const {
  const Place place = placeOf(leg, j);
  if (place.type == dJointTypeSlider) return dJointGetSliderPosition(place.joint);
  if (place.type == dJointTypeHinge) return dJointGetHingeAngle(place.joint);
  return place.outer ? dJointGetUniversalAngle1(place.joint) : dJointGetUniversalAngle2(place.joint);
}

double OdeMachine::rate(int leg, int j) const {
  const Place place = placeOf(leg, j);
  if (place.type != dJointTypeSlider) return axis(leg, j).dot(omegaOf(place.child) - omegaOf(place.parent));
  const Vector3d here = centerOf(place.child);
  return axis(leg, j).dot(velocityAt(place.child, here) - velocityAt(place.parent, here));
}

void OdeMachine::drive(int leg, int j, double rate) {
  const Place place = placeOf(leg, j);
  const auto set = [&](int parameter, double value) {
    if (place.type == dJointTypeSlider) return dJointSetSliderParam(place.joint, parameter, value);
    if (place.type == dJointTypeHinge) return dJointSetHingeParam(place.joint, parameter, value);
    dJointSetUniversalParam(place.joint, parameter + (place.outer ? 0 : dParamGroup2), value);
  };
  set(dParamVel, rate);
  set(dParamFMax, dInfinity);
}

void OdeMachine::addEffort(int leg, int j, double effort) {
  const Place place = placeOf(leg, j);
  const Vector3d f = effort * axis(leg, j), here = anchor(leg, j);
  if (place.type == dJointTypeSlider) {
    dBodyAddForce(place.child, f.x(), f.y(), f.z());
    if (place.parent != nullptr) dBodyAddForceAtPos(place.parent, -f.x(), -f.y(), -f.z(), here.x(), here.y(), here.z());
  } else {
    dBodyAddTorque(place.child, f.x(), f.y(), f.z());
    if (place.parent != nullptr) dBodyAddTorque(place.parent, -f.x(), -f.y(), -f.z());
  }
}

/// ODE's feedback is the joint's whole force on the child, and its moment about the child's mass centre.
double OdeMachine::effort(int leg, int j) const {
  const LegMotion& state = states_[at(leg)];  // where the step began; ODE has moved since
  const std::size_t b = at(chains_[at(leg)].linkOf(j));
  const dJointFeedback& felt = feedback_[at(leg)][b];
  const Vector3d force = vectorOf(felt.f1), moment = vectorOf(felt.t1);
  const Vector3d& axis = state.at.axes[at(j)];
  if (chains_[at(leg)].slides(j)) return axis.dot(force);
  const Vector3d c = state.bodies[b].frame * bodies_[at(2 * leg) + b].center;
  return axis.dot(moment + (c - state.at.anchors[at(j)]).cross(force));
}

void OdeMachine::addWrench(const Vector6d& moment_and_force) {
  const Vector6d& w = moment_and_force;
  dBodyAddTorque(platform().id, w(0), w(1), w(2));
  dBodyAddForce(platform().id, w(3), w(4), w(5));
}

void OdeMachine::addGyroscopic() {
  for (const Body& body : bodies_) {
    const Vector3d w = omegaOf(body.id);
    const Matrix3d R = axesOf(body.id);
    const Vector3d moment = -w.cross(Vector3d(R * (body.inertia * (R.transpose() * w))));
    dBodySetGyroscopicMode(body.id, 0);
    dBodyAddTorque(body.id, moment.x(), moment.y(), moment.z());
  }
}

void OdeMachine::step(double h) {
  if (quick_iterations > 0) dWorldSetQuickStepNumIterations(world_.get(), quick_iterations);
  const int done = quick_iterations > 0 ? dWorldQuickStep(world_.get(), h) : dWorldStep(world_.get(), h);
  if (done == 0 || !position().allFinite()) throw std::runtime_error("ODE's state is not finite");
}

ChainBody OdeMachine::platformBody() const {
  ChainBody out;
  out.frame.linear() = axesOf(platform().id);
  out.frame.translation() = centerOf(platform().id);
  out.omega = omegaOf(platform().id);
  out.velocity = vectorOf(dBodyGetLinearVel(platform().id));
  return out;
}

double OdeMachine::energy() {
  double out = 0;
  for (const Body& body : bodies_) {
    const Vector3d own = axesOf(body.id).transpose() * omegaOf(body.id);
    out += body.mass *
               (vectorOf(dBodyGetLinearVel(body.id)).squaredNorm() / 2 - manipulator.gravity().dot(centerOf(body.id))) +
           own.dot(body.inertia * own) / 2;
  }
  return out;
}

/// The platform's speeds are [ω; ṗ] in B.
void OdeMachine::readMaps(PlacedTree& out) {
  const Matrix3d Q = platformBody().frame.linear();
  for (int i = 0; i < manipulator.legCount(); ++i) {
    const dBodyID distal = bodies_[at(2 * i + 1)].id;
    const Vector3d arm = Q * manipulator.leg(i).platform_point;
    const Vector3d tip = centerOf(distal) + axesOf(distal) * (chains_[at(i)].tip - chains_[at(i)].centers[1]);
    out.gaps[at(i)] = tip - position() - arm;
    for (int j = 0; j < 3; ++j)
      out.legs[at(i)].J.col(j) = placeOf(i, j).type == dJointTypeSlider
                                     ? axis(i, j)
                                     : Vector3d(axis(i, j).cross(Vector3d(tip - anchor(i, j))));
    for (int k = 0; k < 3; ++k) out.legs[at(i)].P.col(k) = Vector3d::Unit(k).cross(arm);
    out.legs[at(i)].P.rightCols<3>().setIdentity();
  }
}

}  // namespace ursula::ode_engine
