// Torques that are changed after the solver, or taken from other instants.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parts/fast/solver.h"
#include "parts/prove/defects.h"

namespace ursula {
namespace {

Defect torque(const char* name, const std::function<void(Vector6d&)>& change) {
  return wrongTorques(name, "torque", [change](const Scenario&) -> ChangeTorques {
    return [change](Vector6d torques, const Motion<double>&) {
      change(torques);
      return torques;
    };
  });
}

/// Torques of another instant of the motion.
Defect timed(const char* name, const std::function<double(double t, double sample)>& change) {
  return wrongTorques(name, "torque", [change](const Scenario& s) -> ChangeTorques {
    const Subject right = nocSubject(*s.manipulator, s.load);
    const auto trajectory = s.trajectory;
    const double duration = trajectory->duration(), sample = duration / 300;
    return [=](const Vector6d&, const Motion<double>& m) {
      return right.torques(trajectory->at(std::clamp(change(m.t, sample), 0.0, duration)));
    };
  });
}

template <class Vector>
Vector toSingle(const Vector& v) {
  return v.template cast<float>().template cast<double>();
}

/// Motion and efforts are rounded to single precision.
Defect singlePrecision() {
  return wrongTorques("single precision", "torque", [](const Scenario& s) -> ChangeTorques {
    const Subject right = nocSubject(*s.manipulator, s.load);
    return [right](const Vector6d&, const Motion<double>& m) {
      const Motion<double> single{static_cast<double>(static_cast<float>(m.t)),
                                  toSingle(m.p),
                                  toSingle(m.Q),
                                  toSingle(m.omega),
                                  toSingle(m.p_dot),
                                  toSingle(m.omega_dot),
                                  toSingle(m.p_ddot)};
      return toSingle(right.torques(single));
    };
  });
}

Defect withLoad(const char* name, const std::function<void(Load&, const Manipulator&)>& change) {
  return {name, "torque", [change](const Scenario& s) {
            const auto load = std::make_shared<Load>(s.load ? *s.load : Load{});
            change(*load, *s.manipulator);
            return nocSubject(*s.manipulator, load);
          }};
}

/// Takes the load of another instant.
Defect lateLoad() {
  return wrongTorques("load late by 1e-6 s", "torque", [](const Scenario& s) -> ChangeTorques {
    const auto solver = std::make_shared<const Solver<double>>(*s.manipulator);
    const auto load = s.load;
    return [solver, load](const Vector6d& torques, const Motion<double>& m) {
      Motion<double> before = m;
      before.t -= 1e-6;
      const Vector6d missing = loadAtP(load.get(), m) - loadAtP(load.get(), before);
      return Vector6d(torques + onActuators(*solver, m, missing));
    };
  });
}

/// Efforts numbered by coordinate, then by leg.
Vector6d numberedByCoordinate(const Vector6d& efforts, const Motors& motors) {
  PerMotor<int> order = {0, 1, 2, 3, 4, 5};
  std::stable_sort(order.begin(), order.end(),
                   [&motors](int a, int b) { return motors[a].coordinate < motors[b].coordinate; });
  Vector6d out;
  for (int k = 0; k < motor_count; ++k) out(k) = efforts(order[k]);
  return out;
}

/// Changes the efforts of motors on one coordinate.
Defect wrongEfforts(const std::string& name, Coordinate coordinate, double factor) {
  return wrongTorques(name, "torque", [coordinate, factor](const Scenario& s) -> ChangeTorques {
    return [motors = s.manipulator->motors(), coordinate, factor](Vector6d torques, const Motion<double>&) {
      for (int k = 0; k < motor_count; ++k)
        if (motors[k].coordinate == coordinate) torques(k) *= factor;
      return torques;
    };
  });
}

/// Defects of sliding coordinates, and of legs with two motors.
std::vector<Defect> wrongMotors(const Manipulator& machine) {
  std::vector<Defect> out;
  for (const Coordinate q : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d}) {
    const auto drives = [q](const Motor& motor) { return motor.coordinate == q; };
    const Motors& motors = machine.motors();
    const auto count = std::count_if(motors.begin(), motors.end(), drives);
    if (count == 0) continue;
    if (count < motor_count) out.push_back(wrongEfforts(fmt::format("sign of the efforts on {}", nameOf(q)), q, -1));
    out.push_back(wrongEfforts(fmt::format("efforts on {} off by 1e-9 of themselves", nameOf(q)), q, 1 + 1e-9));
  }
  out.push_back(wrongTorques("efforts numbered by coordinate before leg", "torque", [](const Scenario& s) {
    return [motors = s.manipulator->motors()](const Vector6d& torques, const Motion<double>&) {
      return numberedByCoordinate(torques, motors);
    };
  }));
  return out;
}

}  // namespace

std::vector<Defect> torqueDefects(const Manipulator& machine) {
  using V = Vector6d;
  using M = Manipulator;
  std::vector<Defect> out = {
      torque("sign of all torques", [](V& tau) { tau = -tau; }),
      torque("sign of torque 3", [](V& tau) { tau(2) = -tau(2); }),
      torque("torques 2 and 5 swapped", [](V& tau) { std::swap(tau(1), tau(4)); }),
      torque("columns of T permuted", [](V& tau) { std::rotate(tau.data(), tau.data() + 5, tau.data() + 6); }),
      torque("torque 1 off by 1e-9 of itself", [](V& tau) { tau(0) *= 1 + 1e-9; }),
      torque("torque 6 left out", [](V& tau) { tau(5) = 0; }),
      torque("torques in kN m", [](V& tau) { tau /= 1000; }),
      torque("torque 4 not a number", [](V& tau) { tau(3) = std::nan(""); }),
      torque("torques off by 1e-10 of themselves", [](V& tau) { tau *= 1 + 1e-10; }),
      timed("held constant between samples", [](double t, double sample) { return sample * std::floor(t / sample); }),
      timed("late by one sample", [](double t, double sample) { return t - sample; }),
      timed("late by 1e-9 s", [](double t, double) { return t - 1e-9; }),
      singlePrecision(),
      withLoad("load in the other frame",
               [](Load& load, const M&) {
                 load.frame = load.frame == Load::Frame::base ? Load::Frame::platform : Load::Frame::base;
               }),
      withLoad("load's point left out", [](Load& load, const M&) { load.point.setZero(); }),
      withLoad("load's point from the mass centre",
               [](Load& load, const M& of) { load.point += of.platform().center_of_mass; }),
      withLoad("load's point off by 1e-9 m", [](Load& load, const M&) { load.point.z() += 1e-9; }),
      lateLoad(),
      control(torque("torque: no fault", [](V&) {})),
      control(timed("time: no fault", [](double t, double) { return t; })),
      control(withLoad("load: no fault", [](Load&, const M&) {}))};
  if (!machine.isOfThePaper()) append(out, wrongMotors(machine));
  return out;
}

}  // namespace ursula
