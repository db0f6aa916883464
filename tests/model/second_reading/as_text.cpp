#include "tests/model/second_reading/as_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <fstream>
#include <vector>

#include "studies/random/dice.h"

namespace ursula {
namespace {

template <class V>
std::string list(const V& values) {
  return fmt::format("[{}]", fmt::join(values.data(), values.data() + values.size(), ", "));
}

std::string tensor(const Matrix3d& I) {
  if (I.isDiagonal(0)) return list(Vector3d(I.diagonal()));
  return list((Vector6d() << I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)).finished());
}

std::string linkText(const char* name, const Link& link) {
  const std::string length = link.length == 0 ? "" : fmt::format("length = {}, ", link.length);
  return fmt::format("{} = {{ {}mass = {}, center_of_mass = {}, inertia = {} }}\n", name, length, link.mass,
                     link.center_of_mass, tensor(link.inertia));
}

/// Writes friction by the coordinates' names, or for a URS leg by those of its joints.
std::string frictionText(const Leg& leg, const JointFriction& friction, bool by_joint) {
  std::vector<std::string> out;
  for (const Coordinate coordinate : rowOf(leg.kind).coordinates) {
    constexpr std::array<const char*, 3> joints = {"actuated", "universal", "knee"};
    const bool joint = by_joint && leg.kind == LegKind::URS;
    out.push_back(fmt::format("{} = {}", joint ? joints[static_cast<std::size_t>(coordinate)] : nameOf(coordinate),
                              friction.on(coordinate)));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

/// Writes zeros, too, because a leg that inherits other values must write them.
std::string rotorText(const Leg& leg) {
  std::vector<std::string> out;
  for (const Coordinate coordinate : rowOf(leg.kind).coordinates)
    if (leg.drives(coordinate))
      out.push_back(fmt::format("{} = {}", nameOf(coordinate), leg.rotor_inertia.on(coordinate)));
  return fmt::format("rotor_inertia = {{ {} }}\n", fmt::join(out, ", "));
}

std::string linksAndFriction(const Leg& leg, bool by_joint) {
  return linkText("proximal", leg.proximal) + linkText("distal", leg.distal) +
         fmt::format("friction = {{ {} }}\ncoulomb = {{ {}, smoothing_speed = {} }}\n",
                     frictionText(leg, leg.friction, by_joint), frictionText(leg, leg.coulomb, !by_joint),
                     leg.coulomb.smoothing_speed) +
         rotorText(leg);
}

std::string motorsText(const Leg& leg) {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < 3; ++j)
    if (leg.actuated[j]) names.push_back(fmt::format("\"{}\"", nameOf(rowOf(leg.kind).coordinates[j])));
  return fmt::format("kind = \"{}\"\nactuated = [{}]\n", rowOf(leg.kind).name, fmt::join(names, ", "));
}

/// The first leg's links and friction are the defaults, which the others override.
std::string machineText(const ManipulatorParameters& machine, std::uint64_t seed) {
  std::string out = fmt::format("[manipulator]\ngravity = {}\n\n[manipulator.platform]\nmass = {}\n",
                                list(machine.gravity), machine.platform.mass);
  out += fmt::format("center_of_mass = {}\ninertia = {}\n\n[manipulator.leg_defaults]\n{}",
                     list(machine.platform.center_of_mass), tensor(machine.platform.inertia),
                     linksAndFriction(machine.legs.front(), seed % 2 == 0));
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const Leg& leg = machine.legs[i];
    out += fmt::format("\n[[manipulator.leg]]\n{}base_point = {}\nbase_axis = {}\nplatform_point = {}\n",
                       motorsText(leg), list(leg.base_point), list(leg.base_axis), list(leg.platform_point));
    if (leg.knee == Knee::negative) out += "knee = \"negative\"\n";
    if (i > 0) out += linksAndFriction(leg, (seed + i) % 2 == 0);
  }
  return out;
}

Eigen::Vector4d quaternionOf(const Motion<double>& motion) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(motion.Q).normalized();
  return {q.w(), q.x(), q.y(), q.z()};
}

std::string poseText(const Motion<double>& motion, bool in_degrees, const char* between) {
  const Matrix3d& Q = motion.Q;
  const Vector3d angles(std::atan2(Q(2, 1), Q(2, 2)), std::asin(std::clamp(-Q(2, 0), -1.0, 1.0)),
                        std::atan2(Q(1, 0), Q(0, 0)));
  const std::string turned = in_degrees ? "rpy_deg = " + list(Vector3d(angles * (180 / 3.14159265358979323846)))
                                        : "orientation = " + list(quaternionOf(motion));
  return fmt::format("position = {}{}{}", list(motion.p), between, turned);
}

std::string helixText(std::uint64_t seed, double duration) {
  Dice dice(seed);
  const auto angle = [&dice](const char* name) {
    const bool degrees = dice.chance(0.5);
    return fmt::format("{}{} = {}\n", name, degrees ? "_deg" : "", dice.uniform(-3, 3) * (degrees ? 60 : 1));
  };
  std::string out = fmt::format("kind = \"helix\"\nduration = {}\nradius = {}\npitch = {}\n", duration,
                                dice.spread(1e-3, 10), dice.spreadOfEitherSign(1e-3, 10));
  for (const char* name : {"start_angle", "end_angle"}) out += angle(name);
  for (const char* name : {"phase", "height_phase"})
    if (dice.chance(0.5)) out += angle(name);
  for (const char* name : {"start_rate", "end_rate", "start_acceleration", "end_acceleration"})
    if (dice.chance(0.5)) out += fmt::format("{} = {}\n", name, dice.uniform(-1, 1));
  return out;
}

std::string trajectoryText(const Trajectory& trajectory, std::uint64_t seed, const std::filesystem::path& folder) {
  const std::string kind = trajectory.kind();
  if (kind == "helix") return helixText(seed, trajectory.duration());
  const bool in_degrees = seed % 2 == 0;
  std::string out = fmt::format("kind = \"{}\"\n", kind);
  if (kind == "hold")
    return out +
           fmt::format("duration = {}\n{}\n", trajectory.duration(), poseText(trajectory.at(0), in_degrees, "\n"));
  if (kind == "samples") {
    std::ofstream table(folder / "samples.csv");
    table << "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n";
    for (const double t : trajectory.knots()) {
      const Motion<double> motion = trajectory.at(t);
      const Eigen::Vector4d q = quaternionOf(motion);
      table << fmt::format("{},{},{}\n", t, fmt::join(motion.p.data(), motion.p.data() + 3, ", "),
                           fmt::join(q.data(), q.data() + 4, ","));
    }
    return out + "file = \"samples.csv\"\n";
  }
  out += "points = [\n";
  for (const double t : trajectory.knots())
    out += fmt::format("  {{ time = {}, {} }},\n", t, poseText(trajectory.at(t), in_degrees, ", "));
  return out + "]\n";
}

std::string loadText(const Load& load, std::uint64_t seed, const std::filesystem::path& folder) {
  std::string out = fmt::format("\n[load]\npoint = {}\nframe = \"{}\"\n", list(load.point),
                                load.frame == Load::Frame::base ? "base" : "platform");
  if (!load.history) return out + fmt::format("force = {}\nmoment = {}\n", list(load.force), list(load.moment));
  std::string rows;
  for (const TimedWrench& row : load.history->rows()) {
    const Vector3d &f = row.wrench.force, &m = row.wrench.moment;
    rows += seed % 2 == 0 ? fmt::format("  {{ time = {}, force = {}, moment = {} }},\n", row.time, list(f), list(m))
                          : fmt::format("{},{},{}\n", row.time, fmt::join(f.data(), f.data() + 3, ","),
                                        fmt::join(m.data(), m.data() + 3, " , "));
  }
  if (seed % 2 == 0) return out + "table = [\n" + rows + "]\n";
  std::ofstream(folder / "load.csv") << "t_s,f_x_N,f_y_N,f_z_N,m_x_Nm,m_y_Nm,m_z_Nm\n" << rows;
  return out + "file = \"load.csv\"\n";
}

}  // namespace

std::string asText(const Scenario& scenario, std::uint64_t seed, const std::filesystem::path& folder) {
  return "name = \"random\"\n\n" + machineText(scenario.manipulator->parameters(), seed) + "\n[trajectory]\n" +
         trajectoryText(*scenario.trajectory, seed, folder) +
         (scenario.load ? loadText(*scenario.load, seed, folder) : "");
}

}  // namespace ursula
