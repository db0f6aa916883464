#include "validation/subject/leg_points.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "model/instants.h"

namespace ursula {

std::vector<LegPoints> legPoints(const Manipulator& machine, const NocWorkspace<double>& work) {
  std::vector<LegPoints> out;
  for (int i = 0; i < machine.legCount(); ++i) {
    const Leg& leg = machine.leg(i);
    const LegState<double>& state = work.legs[i];
    LegPoints points;
    points.A = leg.base_point;
    points.S = points.A + state.O_2;
    points.B = points.A + state.AB;
    points.R = rowOf(leg.kind).isTelescopic() ? Vector3d(points.A + leg.proximal.length * state.axis[2]) : points.S;
    points.axes = state.axis;
    out.push_back(points);
  }
  return out;
}

namespace {

/// The range of a carriage's d so far.
struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;

  void include(double d) { least = std::min(least, d), most = std::max(most, d); }
};

std::vector<Range> travels(const Scenario& scenario) {
  const Noc<double> solver(*scenario.manipulator);
  NocWorkspace<double> work;
  std::vector<Range> out(scenario.manipulator->parameters().legs.size());
  try {
    for (const double t : equallySpaced(scenario.trajectory->duration(), 201)) {
      solver.displacements(scenario.trajectory->at(t), work);
      for (std::size_t i = 0; i < out.size(); ++i) out[i].include(solver.angles(work).d(static_cast<int>(i)));
    }
  } catch (const PoseError&) {
    // The part of the motion before this pose is drawn.
  }
  return out;
}

}  // namespace

std::vector<std::optional<RailSection>> rails(const Scenario& scenario) {
  const std::vector<Leg>& legs = scenario.manipulator->parameters().legs;
  std::vector<std::optional<RailSection>> out(legs.size());
  const auto slides = [](const Leg& leg) { return rowOf(leg.kind).hasCarriage(); };
  if (std::none_of(legs.begin(), legs.end(), slides)) return out;
  std::vector<Range> travelled = travels(scenario);
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (!slides(legs[i])) continue;
    travelled[i].include(0);
    const double more = legs[i].distal.length / 10;
    const Vector3d u = legs[i].base_axis.stableNormalized();
    out[i] = RailSection{legs[i].base_point + (travelled[i].least - more) * u,
                         legs[i].base_point + (travelled[i].most + more) * u};
  }
  return out;
}

}  // namespace ursula
