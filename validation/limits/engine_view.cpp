#include "validation/limits/engine_view.h"

#include "simbody/simbody_loop.h"
#include "validation/verdict/worst_share.h"

namespace ursula {

struct EngineFrameChange::Engines {
  Engines(const Manipulator& machine, const std::shared_ptr<const Load>& load, const FormulationFaults& faults)
      : fault(faults.simbody),
        ball_per_leg(fault.applied(machine), SimbodyLoop::Topology::ball_per_leg, load),
        further(makeFurtherEngines(machine, load, faults.further)) {}

  EngineFault fault;
  SimbodyLoop ball_per_leg;
  OfFurtherEngines<std::unique_ptr<Engine>> further;
};

namespace {

/// Converts [ω̇; p̈] back to the scenario's frame.
Vector6d twistRateBack(const FrameChange& p, const Motion<double>& motion) {
  const double unit = p.units.time * p.units.time;
  Vector6d out;
  out << p.turn.transpose() * motion.omega_dot / unit, p.turn.transpose() * motion.p_ddot * p.units.length / unit;
  return out;
}

}  // namespace

EngineFrameChange::EngineFrameChange(const Scenario& scenario, const FrameChange& frame_change,
                                     const FormulationFaults& faults)
    : frame_change_(frame_change),
      engines_(std::make_unique<Engines>(frame_change.transformed(*scenario.manipulator),
                                         frame_change.transformed(scenario.load), faults)) {}
EngineFrameChange::~EngineFrameChange() = default;
EngineFrameChange::EngineFrameChange(EngineFrameChange&&) noexcept = default;

EngineView EngineFrameChange::at(const Motion<double>& motion, const Vector6d& torques, const Vector6d& others) {
  const FrameChange& p = frame_change_;
  Engines& e = *engines_;
  const Motion<double> there = p.transformed(motion);
  EngineView out;
  out.joints = p.back(e.ball_per_leg.place(there));
  out.bodies = p.back(e.ball_per_leg.bodies());
  out.torques = p.torquesBack(e.fault.applied(e.ball_per_leg.inverseDynamics()));
  e.ball_per_leg.accelerate(p.transformed(torques));
  out.acceleration = twistRateBack(p, e.ball_per_leg.platform());
  out.gap_acceleration = e.ball_per_leg.gapAcceleration() * p.units.acceleration();
  out.reactions = p.back(e.ball_per_leg.reactions());
  e.ball_per_leg.accelerate(p.transformed(others));
  out.direct = twistRateBack(p, e.ball_per_leg.platform());
  for (std::size_t k = 0; k < furtherEngines().size(); ++k)
    if (e.further[k]) out.further[k] = p.torquesBack(e.further[k]->inverseDynamics(there));
  return out;
}

double distance(const LegReactions& a, const LegReactions& b, double length) {
  double difference = 0;
  for (Vector3d LegReactions::*force : {&LegReactions::f_A, &LegReactions::f_R, &LegReactions::f_B})
    difference = larger(difference, (a.*force - b.*force).norm());
  for (Vector3d LegReactions::*moment : {&LegReactions::n_A, &LegReactions::n_R})
    difference = larger(difference, (a.*moment - b.*moment).norm() / length);
  return difference;
}

}  // namespace ursula
