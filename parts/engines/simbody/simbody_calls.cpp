// Asks Simbody for efforts of a closed loop as its users do, and lets it step one in time.

#include <Eigen/LU>
#include <stdexcept>
#include <utility>

#include "parts/engines/loop_engine.h"
#include "simbody/simbody_loop.h"

namespace ursula {
namespace {

/// Reverses the rows' signs, because Simbody's are the platform's point minus the leg's.
void turnRows(OpenTree& out) {
  for (OpenTree::Leg& leg : out.legs) {
    leg.J = -leg.J;
    leg.P = -leg.P;
  }
}

void readGaps(const SimbodyLoop& loop, const Manipulator& manipulator, PlacedTree& out) {
  const BodyMotions<double> bodies = loop.bodies();
  const Motion<double> platform = loop.platform();
  for (int i = 0; i < manipulator.legCount(); ++i) {
    const Leg& leg = manipulator.leg(i);
    const BodyMotion<double>& distal = bodies[leg_count + i];
    const Vector3d tip = distal.c + distal.R * (Vector3d(0, 0, leg.distal.length) - leg.distalCenter());
    out.gaps[i] = tip - platform.p - platform.Q * leg.platform_point;
  }
}

/// Simbody's own integrator moves the loop, with its constraints and their projection.
class SimbodyStepped : public SteppedLoop {
 public:
  SimbodyStepped(const Manipulator& manipulator, std::shared_ptr<const Load> load, const Rigidity& rigidity)
      : manipulator_(manipulator),
        loop_(manipulator, SimbodyLoop::Topology::ball_per_leg, std::move(load)),
        step_(rigidity.step),
        accuracy_(rigidity.settings.at(0).second) {}

  void start(const Motion<double>& motion) override {
    loop_.place(motion);
    t_ = motion.t;
  }

  void step(const Vector6d& efforts) override {
    t_ += step_;
    efforts_ = efforts;
    const auto held = [&efforts](double) { return efforts; };
    if (loop_.integrateRungeKuttaMerson(accuracy_, held, {t_}, [](double) {}).gave_up)
      throw std::runtime_error("Simbody's integrator gave up");
  }

  void read(State& out) override {
    const JointMotion joints = loop_.joints();
    out.q = joints.q.driven(manipulator_.motors());
    const SimbodyLoop::Energy energy = loop_.energy();
    out.energy = energy.kinetic + energy.potential;
    loop_.accelerate(efforts_);
    const SimbodyLoop::Power power = loop_.power();
    out.power = power.friction + power.load;
    const Motion<double> platform = loop_.platform();
    out.p = platform.p;
    loop_.coordinates(platform, joints, at_);
    loop_.openTree(at_, out.tree);
    turnRows(out.tree);
    readGaps(loop_, manipulator_, out.tree);
  }

 private:
  Manipulator manipulator_;
  SimbodyLoop loop_;
  double step_, accuracy_, t_ = 0;
  Vector6d efforts_ = Vector6d::Zero();
  TreeCoordinates at_;
};

class SimbodyCalls : public LoopEngine {
 public:
  SimbodyCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : LoopEngine(manipulator),
        load_(load),
        loop_(manipulator, SimbodyLoop::Topology::ball_per_leg, std::move(load)) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    JointMotion joints = loop_.place(motion);
    ask(motion, joints);
    if (bias == Bias::kept) return tree_;
    Vector6d twist_rate;
    twist_rate << motion.omega_dot, motion.p_ddot;
    for (int i = 0; i < manipulator().legCount(); ++i) {
      const OpenTree::Leg& leg = tree_.legs[i];
      const Vector3d accelerations = leg.J.partialPivLu().solve(leg.P * twist_rate);
      for (int j = 0; j < 3; ++j)
        joints.q_ddot.of(rowOf(manipulator().leg(i).kind).coordinates[j])(i) = accelerations(j);
    }
    ask(motion, joints);
    return tree_;
  }

  std::vector<Rigidity> rigidities() const override {
    return {{"default", 0.002, 0.5, {{"accuracy", 1e-3}}}};  // other accuracies change nothing over so short a step
  }

  std::unique_ptr<SteppedLoop> stepped(const Rigidity& rigidity) const override {
    return std::make_unique<SimbodyStepped>(manipulator(), load_, rigidity);
  }

 private:
  void ask(const Motion<double>& motion, const JointMotion& joints) {
    loop_.coordinates(motion, joints, at_);
    loop_.openTree(at_, tree_);
    turnRows(tree_);
    readGaps(loop_, manipulator(), tree_);
  }

  std::shared_ptr<const Load> load_;
  SimbodyLoop loop_;
  TreeCoordinates at_;
  PlacedTree tree_;
};

}  // namespace

std::unique_ptr<LoopEngine> makeSimbodyCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<SimbodyCalls>(manipulator, std::move(load));
}

}  // namespace ursula
