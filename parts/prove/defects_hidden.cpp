// Torques that only another machine or another motion shows to be wrong.

#include <algorithm>

#include "parts/prove/defects.h"

namespace ursula {
namespace {

/// Whether the solver is wrong for this machine and motion.
using Wrong = std::function<bool(const Manipulator&, const Motion<double>&)>;

Subject wrongWhere(const Manipulator& machine, const std::shared_ptr<const Load>& load, const Wrong& wrong) {
  const Subject right = nocSubject(machine, load);
  Subject out = right;
  out.torques = [right, machine, wrong](const Motion<double>& m) {
    return Vector6d((wrong(machine, m) ? 1 + 1e-8 : 1) * right.torques(m));
  };
  out.rebuilt = [wrong](const Manipulator& other) { return wrongWhere(other, nullptr, wrong); };
  return out;
}

Defect hidden(const char* name, const std::function<Wrong(const Scenario&)>& make) {
  Defect out{name, "hidden", [make](const Scenario& s) { return wrongWhere(*s.manipulator, s.load, make(s)); }};
  out.formulations_wanted = 1;
  return out;
}

Defect hiddenMachine(const char* name, bool (*wrong)(const Manipulator&)) {
  return hidden(name, [wrong](const Scenario&) -> Wrong {
    return [wrong](const Manipulator& machine, const Motion<double>&) { return wrong(machine); };
  });
}

/// Wrong while P moves up or down at a speed that the commanded motion lacks but its reversal has.
Wrong beyondSpeeds(const Scenario& s) {
  double low = 0, high = 0;
  constexpr int instants = 6000;
  for (int k = 0; k <= instants; ++k) {
    const double speed = s.trajectory->at(s.trajectory->duration() * k / instants).p_dot.z();
    low = std::min(low, speed);
    high = std::max(high, speed);
  }
  const double margin = 1e-3 * (high - low);
  return [=](const Manipulator&, const Motion<double>& m) {
    return high > -low ? m.p_dot.z() < low - margin : m.p_dot.z() > high + margin;
  };
}

/// Wrong for machines slightly different from this one, which the invariances and the reversed motion use.
std::vector<Defect> hiddenInAny(const Manipulator& machine) {
  const auto beyond = [](const char* name, double (*of)(const Manipulator&), double factor) {
    return hidden(name, [of, factor](const Scenario& s) -> Wrong {
      const double bound = factor * of(*s.manipulator);
      return [of, bound](const Manipulator& other, const Motion<double>&) { return of(other) > bound; };
    });
  };
  std::vector<Defect> out = {hidden("wrong where gravity has another direction",
                                    [](const Scenario& s) -> Wrong {
                                      const Vector3d gravity = s.manipulator->gravity();
                                      return [gravity](const Manipulator& m, const Motion<double>&) {
                                        return m.gravity().dot(gravity) < 0.94 * m.gravity().norm() * gravity.norm();
                                      };
                                    }),
                             beyond(
                                 "wrong where the platform is heavier by a fifth",
                                 [](const Manipulator& m) { return m.platform().mass; }, 1.2),
                             hidden("wrong where leg 1 stands elsewhere",
                                    [](const Scenario& s) -> Wrong {
                                      const Vector3d own = s.manipulator->leg(0).platform_point;
                                      const double near = 0.1 * own.norm();
                                      return [own, near](const Manipulator& m, const Motion<double>&) {
                                        return (m.leg(0).platform_point - own).norm() > near;
                                      };
                                    }),
                             hidden("wrong at speeds that only the way back has", beyondSpeeds)};
  const bool has_friction = std::any_of(machine.parameters().legs.begin(), machine.parameters().legs.end(),
                                        [](const Leg& leg) { return leg.friction.any() || leg.coulomb.any(); });
  if (has_friction)
    out.push_back(hiddenMachine("wrong where nothing has_friction", [](const Manipulator& m) {
      const auto& legs = m.parameters().legs;
      return std::none_of(legs.begin(), legs.end(),
                          [](const Leg& leg) { return leg.friction.any() || leg.coulomb.any(); });
    }));
  return out;
}

}  // namespace

std::vector<Defect> hiddenDefects(const Manipulator& machine) {
  if (!machine.isOfThePaper()) return hiddenInAny(machine);
  return {hiddenMachine("wrong where the base is tilted by more than 20 degrees",
                        [](const Manipulator& m) { return -m.gravity().z() < 0.94 * m.gravity().norm(); }),
          hiddenMachine("wrong where leg 1 has its knee the other way",
                        [](const Manipulator& m) { return m.leg(0).knee == Knee::negative; }),
          hiddenMachine("wrong where leg 1 is longer than 1.42 m",
                        [](const Manipulator& m) { return m.leg(0).proximal.length > 1.42; }),
          hiddenMachine("wrong where the platform is heavier than 600 kg, and lighter than 1,200",
                        [](const Manipulator& m) { return m.platform().mass > 600 && m.platform().mass < 1200; }),
          hiddenMachine("wrong where nothing has_friction",
                        [](const Manipulator& m) { return m.leg(0).friction.theta == 0; }),
          hidden("wrong at speeds that only the way back has", beyondSpeeds)};
}

}  // namespace ursula
