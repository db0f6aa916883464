#include "tests/validation/injected_causes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "parts/causes/diagnosis.h"
#include "tests/support/changed.h"
#include "tests/support/motions.h"
#include "tests/validation/external_torques.h"
#include "tests/validation/scenario_files.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;
constexpr int injected_instants = 61;

/// Puts causes into the torques of one scenario.
class Bench {
 public:
  /// `wanted` is asked once for each cause.
  Bench(const std::string& name, const std::function<bool()>& wanted, std::vector<InjectedCause>& out)
      : name_(name),
        scenario_(scenarioOf(name)),
        exact_(exactTorques(scenario_, injected_instants)),
        wanted_(wanted),
        out_(out) {}

  void machine(const std::string& put_in, const std::string& expected, const MachineChange& change) {
    add(put_in, expected, ofMachine(change).file());
  }

  /// The same, printed with few significant digits.
  void printed(int digits, const std::string& put_in, const std::string& expected, const MachineChange& change) {
    add(fmt::format("{}; {} digits", put_in, digits), expected,
        ofMachine(change).printed(fmt::format("{{:.{}g}}", digits)));
  }

  void motion(const std::string& put_in, const std::string& expected,
              const std::function<void(Motion<double>&)>& change) {
    const Subject noc = solverOf(scenario_);
    add(put_in, expected,
        exact_
            .changed([&](std::size_t k, Vector6d& tau) {
              Motion<double> motion = scenario_.trajectory->at(exact_.t[k]);
              change(motion);
              tau = noc.torques(motion);
            })
            .file());
  }

  void torques(const std::string& put_in, const std::string& expected,
               const std::function<void(std::size_t, Vector6d&)>& change) {
    add(put_in, expected, exact_.changed(change).file());
  }

  void shifted(const std::string& put_in, const std::string& expected, double shift) {
    motion(put_in, expected, [this, shift](Motion<double>& motion) {
      motion = scenario_.trajectory->at(std::clamp(motion.t + shift, 0.0, scenario_.trajectory->duration()));
    });
  }

  const Scenario& scenario() const { return scenario_; }

 private:
  TorqueTable ofMachine(const MachineChange& change) const {
    Machine machine = scenario_.manipulator->parameters();
    change(machine);
    return torquesOf(scenario_, nocSubject(Manipulator(machine), scenario_.load), exact_.t);
  }

  void add(const std::string& put_in, const std::string& expected, const TorqueFile& file) {
    if (wanted_()) out_.push_back({name_, put_in, expected, diagnose(scenario_, runExternal(scenario_, file)).cause});
  }

  std::string name_;
  Scenario scenario_;
  TorqueTable exact_;
  const std::function<bool()>& wanted_;
  std::vector<InjectedCause>& out_;
};

void addToTorques(Bench& out) {
  out.torques("every torque in kN m", "(kN m for N m)", [](std::size_t, Vector6d& tau) { tau *= 1e-3; });
  out.torques("every torque in N mm", "(N mm or mN m for N m)", [](std::size_t, Vector6d& tau) { tau *= 1e3; });
  out.torques("every torque in lbf ft", "(lbf ft for N m)",
              [](std::size_t, Vector6d& tau) { tau *= 0.7375621492772653; });
  out.torques("every sign turned", "the sign of every leg flipped", [](std::size_t, Vector6d& tau) { tau *= -1; });
  out.torques("signs of legs 2, 4, 6 turned", "the sign of legs 2, 4 and 6 flipped", [](std::size_t, Vector6d& tau) {
    for (int i : {1, 3, 5}) tau(i) *= -1;
  });
  out.torques("legs 1 and 2 swapped", "legs 1 and 2 swapped",
              [](std::size_t, Vector6d& tau) { std::swap(tau(0), tau(1)); });
  out.torques("legs numbered from the third", "legs numbered from another one", [](std::size_t, Vector6d& tau) {
    const Vector6d old = tau;
    for (int i = 0; i < leg_count; ++i) tau(i) = old((i + 2) % leg_count);
  });
  out.torques("legs numbered backwards, in kN m", "(mirrored)",
              [](std::size_t, Vector6d& tau) { tau = 1e-3 * tau.reverse().eval(); });
  out.torques("an offset of 3 N m on leg 5", "a constant offset: +3 N m on leg 5",
              [](std::size_t, Vector6d& tau) { tau(4) += 3; });
  out.torques("leg 6 times 1.01", "a factor of 1.01 on leg 6", [](std::size_t, Vector6d& tau) { tau(5) *= 1.01; });
  out.torques("every torque times 1.003", "every torque scaled by 1.003",
              [](std::size_t, Vector6d& tau) { tau *= 1.003; });
  out.torques("single precision", "single precision",
              [](std::size_t, Vector6d& tau) { tau = tau.cast<float>().cast<double>().eval(); });
  out.shifted("50 ms early", "a time shift: the torques of 50 ms after (early), 1 sample", 0.05);
  out.shifted("7 ms late", "a time shift: the torques of 7 ms before (late)", -0.007);
}

void addMasses(Bench& out) {
  out.machine("gravity 9.80665", "standard gravity", [](Machine& m) { m.gravity *= 9.80665 / m.gravity.norm(); });
  out.machine("no gravity", "gravity left out", [](Machine& m) { m.gravity.setZero(); });
  out.machine("gravity upwards", "gravity with the wrong sign", [](Machine& m) { m.gravity *= -1; });
  out.machine("gravity tilted along x by 1e-3", "gravity x", [](Machine& m) { m.gravity.x() += 9.81e-3; });
  out.machine("platform mass + 2 %", "platform mass", [](Machine& m) { m.platform.mass *= 1.02; });
  out.printed(6, "platform mass + 0.1 %", "platform mass", [](Machine& m) { m.platform.mass *= 1.001; });
  out.machine("platform mass centre 1 cm higher", "platform mass centre z",
              [](Machine& m) { m.platform.center_of_mass.z() += 0.01; });
  out.machine("platform mass centre 5 mm along x", "platform mass centre x",
              [](Machine& m) { m.platform.center_of_mass.x() += 0.005; });
  out.machine("platform mass centre at P", "mass centre of the platform taken at P",
              [](Machine& m) { m.platform.center_of_mass.setZero(); });
  out.machine("platform inertia tensor - 5 %", "platform inertia tensor scaled by 0.95",
              [](Machine& m) { m.platform.inertia *= 0.95; });
  out.machine("platform inertia about P", "inertia of the platform about P used", [](Machine& m) {
    const Vector3d r = m.platform.center_of_mass;
    m.platform.inertia += m.platform.mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
  });
}

void addLinks(Bench& out) {
  out.machine("mass of every proximal link + 3 %", "mass of the proximal links",
              ofEachLeg([](Leg& l) { l.proximal.mass *= 1.03; }));
  out.machine("mass of every distal link - 5 %", "mass of the distal links",
              ofEachLeg([](Leg& l) { l.distal.mass *= 0.95; }));
  out.machine("mass of every link + 10 %", "mass of all links",
              ofEachLeg([](Leg& l) { l.proximal.mass *= 1.1, l.distal.mass *= 1.1; }));
  out.machine("mass of leg 3's distal link + 1 %", "mass of the distal link of leg 3",
              [](Machine& m) { m.legs[2].distal.mass *= 1.01; });
  out.machine("mass of leg 2's links + 1 %", "mass of both links of leg 2",
              [](Machine& m) { m.legs[1].distal.mass *= 1.01, m.legs[1].proximal.mass *= 1.01; });
  out.machine("mass centres of distal links - 7 %", "mass centre of the distal links",
              ofEachLeg([](Leg& l) { l.distal.center_of_mass *= 0.93; }));
  out.machine("mass centres of proximal links + 5 %", "mass centre of the proximal links",
              ofEachLeg([](Leg& l) { l.proximal.center_of_mass *= 1.05; }));
  out.machine("mass centre of leg 4's proximal link + 2 %", "mass centre of the proximal link of leg 4",
              [](Machine& m) { m.legs[3].proximal.center_of_mass *= 1.02; });
  out.machine("mass centres of all links - 4 %", "mass centre of all links",
              ofEachLeg([](Leg& l) { l.proximal.center_of_mass *= 0.96, l.distal.center_of_mass *= 0.96; }));
  out.machine("mass centres of distal links at R", "mass centres of the distal links at their first joints",
              ofEachLeg([](Leg& l) { l.distal.center_of_mass = 0; }));
  out.printed(5, "mass centres of distal links - 7 %", "mass centre of the distal links",
              ofEachLeg([](Leg& l) { l.distal.center_of_mass *= 0.93; }));
  out.machine("inertias of links about their first joints", "inertias of all links about the first joint",
              ofEachLeg([](Leg& l) {
                for (Link* link : {&l.proximal, &l.distal}) {
                  const double more = link->mass * link->center_of_mass * link->center_of_mass;
                  link->inertia(0, 0) += more, link->inertia(1, 1) += more;
                }
              }));
  out.machine("inertias of proximal and distal links exchanged", "proximal and distal inertias exchanged",
              ofEachLeg([](Leg& l) { std::swap(l.proximal.inertia, l.distal.inertia); }));
}

void addGeometry(Bench& out) {
  out.machine("length of every proximal link + 1 mm", "length of the proximal links",
              ofEachLeg([](Leg& l) { l.proximal.length += 0.001; }));
  out.machine("length of every distal link - 5 mm", "length of the distal links",
              ofEachLeg([](Leg& l) { l.distal.length -= 0.005; }));
  out.machine("length of all links + 1 %", "length of all links",
              ofEachLeg([](Leg& l) { l.proximal.length *= 1.01, l.distal.length *= 1.01; }));
  out.machine("length of leg 1's distal link + 2 mm", "length of the distal link of leg 1",
              [](Machine& m) { m.legs[0].distal.length += 0.002; });
  out.machine("base point of leg 2 off by 1 mm along y", "base point y of leg 2",
              [](Machine& m) { m.legs[1].base_point.y() += 0.001; });
  out.machine("base points 2 mm higher", "base point z of every leg",
              ofEachLeg([](Leg& l) { l.base_point.z() += 0.002; }));
  out.machine("platform point of leg 5 off by 1 mm along x", "platform point x of leg 5",
              [](Machine& m) { m.legs[4].platform_point.x() += 0.001; });
  out.machine("base axis of leg 6 turned by 0.5 deg", "base axis", [](Machine& m) {
    Vector3d& u = m.legs[5].base_axis;
    u = Eigen::AngleAxisd(0.00872664625997165, u.unitOrthogonal()) * u;
  });
  out.machine("base axes without z", "base axes without their part along z",
              ofEachLeg([](Leg& l) { l.base_axis.z() = 0; }));
  const auto other_knee = [](Leg& l) { l.knee = l.knee == Knee::positive ? Knee::negative : Knee::positive; };
  out.machine("the other knee on leg 3", "the other knee on leg 3", [&](Machine& m) { other_knee(m.legs[2]); });
  out.machine("the other knee on legs 1 and 4", "the other knee on legs 1, 4",
              [&](Machine& m) { other_knee(m.legs[0]), other_knee(m.legs[3]); });
  out.machine("the other knee everywhere", "the other knee on every leg", ofEachLeg(other_knee));
}

void addMotions(Bench& out) {
  out.motion("no acceleration at all", "the torques of acceleration (inertia) left out",
             [](Motion<double>& m) { m.omega_dot.setZero(), m.p_ddot.setZero(); });
  out.motion("no angular acceleration", "the angular acceleration left out",
             [](Motion<double>& m) { m.omega_dot.setZero(); });
  out.motion("omega and its rate with the wrong sign", "omega and its rate with the wrong sign",
             [](Motion<double>& m) { m.omega *= -1, m.omega_dot *= -1; });
  out.motion("Q for its transpose", "Q taken for its transpose", [](Motion<double>& m) { m.Q.transposeInPlace(); });
  out.motion("omega in the platform's frame", "omega and its rate taken in the platform's frame",
             [](Motion<double>& m) {
               m.omega = (m.Q.transpose() * m.omega).eval(), m.omega_dot = (m.Q.transpose() * m.omega_dot).eval();
             });
}

void addFriction(Bench& out) {
  out.machine("viscous friction of 5 on every phi", "viscous friction on every phi of 5",
              ofEachLeg([](Leg& l) { l.friction.phi += 5; }));
  out.machine("no friction", "friction left out", ofEachLeg([](Leg& l) {
                l.friction = {};
                l.coulomb.phi = l.coulomb.psi = l.coulomb.theta = 0;
              }));
  out.machine("viscous friction on leg 1's psi + 10 %", "viscous friction on psi of leg 1",
              [](Machine& m) { m.legs[0].friction.psi *= 1.1; });
  out.machine("inertia xy of the platform + 10 %", "platform inertia xy",
              [](Machine& m) { m.platform.inertia(0, 1) *= 1.1, m.platform.inertia(1, 0) *= 1.1; });
  out.machine("inertia zz of leg 2's proximal link + 10 %", "inertia zz of the proximal link of leg 2",
              [](Machine& m) { m.legs[1].proximal.inertia(2, 2) *= 1.1; });
  out.motion("platform's mass centre for P in the rates",
             "velocity and acceleration of the platform's mass centre taken for those of P", [&](Motion<double>& m) {
               const Vector3d r = m.Q * out.scenario().manipulator->platform().center_of_mass;
               m.p_dot += m.omega.cross(r);
               m.p_ddot += m.omega_dot.cross(r) + m.omega.cross(m.omega.cross(r));
             });
}

/// What has no single cause: nothing may be claimed.
void addNothing(Bench& out) {
  SeededDraws dice(11);
  out.torques("noise of 1 N m", "",
              [&](std::size_t, Vector6d& tau) { tau += Vector6d::NullaryExpr([&] { return dice.between(-1, 1); }); });
  out.torques("a hump on leg 3", "", [](std::size_t k, Vector6d& tau) {
    tau(2) += 20 * std::exp(-0.01 * (static_cast<double>(k) - 30) * (static_cast<double>(k) - 30));
  });
  out.machine("platform mass + 1 % and distal lengths + 3 mm", "two mistakes together: platform mass 505",
              [](Machine& m) {
                m.platform.mass *= 1.01;
                for (Leg& leg : m.legs) leg.distal.length += 0.003;
              });
  out.machine("every mass centre at random", "", [&](Machine& m) {
    for (Leg& leg : m.legs)
      leg.distal.center_of_mass += dice.between(-0.05, 0.05), leg.proximal.center_of_mass += dice.between(-0.05, 0.05);
  });
}

std::string cell(std::string text) {
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

}  // namespace

bool InjectedCause::isNamedFirst() const {
  const std::string first = said.substr(0, said.find("; as well explained by"));
  return expected.empty()
             ? !isClaimed()
             : first.find("explains only") == std::string::npos && first.find(expected) != std::string::npos;
}

bool InjectedCause::isClaimed() const {
  for (const char* unclaimed : {"a likely part", "no ", "single precision"})
    if (said.rfind(unclaimed, 0) == 0) return false;
  return !said.empty() && said.find("; as well explained by: ") == std::string::npos;
}

std::vector<InjectedCause> diagnoseInjectedCauses(int every) {
  std::vector<InjectedCause> out;
  int asked = 0;
  const std::function<bool()> wanted = [&] { return asked++ % every == 0; };
  Bench helix("paper-helix", wanted, out), ground("proving-ground", wanted, out);
  addToTorques(helix);
  addMasses(helix);
  addLinks(helix);
  addGeometry(helix);
  addMotions(helix);
  addGeometry(ground);
  addMotions(ground);
  addFriction(ground);
  addNothing(helix);
  return out;
}

std::string markdownTable(const std::vector<InjectedCause>& causes) {
  std::string out = "| scenario | put in | said |\n| --- | --- | --- |\n";
  for (const InjectedCause& one : causes)
    out += fmt::format("| {} | {} | {}{} |\n", one.scenario, cell(one.put_in),
                       one.isNamedFirst() ? ""
                       : one.isWrong()    ? "**wrong:** "
                                          : "*not named first:* ",
                       cell(one.said));
  return out;
}

}  // namespace ursula
