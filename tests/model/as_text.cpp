#include "tests/model/as_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <fstream>
#include <vector>

#include "base/real50.h"
#include "model/trajectories/trajectories.h"
#include "parts/random/dice.h"

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

/// A mass centre off the link's line is a vector in the link's frame, whose z, or y of a carriage, is along the line.
std::string linkText(const char* name, const Link& link, int line) {
  const std::string length = link.length == 0 ? "" : fmt::format("length = {}, ", link.length);
  const Vector3d center = link.off_line + link.center_of_mass * Vector3d::Unit(line);
  return fmt::format("{} = {{ {}mass = {}, center_of_mass = {}, inertia = {} }}\n", name, length, link.mass,
                     link.off_line.isZero(0) ? fmt::to_string(link.center_of_mass) : list(center),
                     tensor(link.inertia));
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
  return linkText("proximal", leg.proximal, leg.kind == LegKind::PUS ? 1 : 2) + linkText("distal", leg.distal, 2) +
         fmt::format("friction = {{ {} }}\ncoulomb = {{ {}, smoothing_speed = {} }}\n",
                     frictionText(leg, leg.friction, by_joint), frictionText(leg, leg.coulomb, !by_joint),
                     leg.coulomb.smoothing_speed) +
         fmt::format("spin = \"{}\"\n", leg.spins ? "free" : "held") + rotorText(leg);
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

double inRadians(double degrees) {
  return static_cast<double>(Real50(degrees) * Real50("3.14159265358979323846264338327950288419716939937510582097") /
                             180);
}

std::string poseText(const TimedPose& pose, bool in_degrees, const char* between) {
  const Eigen::Vector4d& q = pose.orientation;
  const Matrix3d Q = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix();
  const Vector3d angles(std::atan2(Q(2, 1), Q(2, 2)), std::asin(std::clamp(-Q(2, 0), -1.0, 1.0)),
                        std::atan2(Q(1, 0), Q(0, 0)));
  return fmt::format("position = {}{}{}", list(pose.position), between,
                     in_degrees ? "rpy_deg = " + list(Vector3d(angles / inRadians(1))) : "orientation = " + list(q));
}

/// Draws a helix, and writes each angle in radians or in degrees.
std::string helixText(std::uint64_t seed, HelixParameters& helix) {
  Dice dice(seed);
  helix.radius = dice.spread(1e-3, 10);
  helix.pitch = dice.spreadOfEitherSign(1e-3, 10);
  std::string out = fmt::format("kind = \"helix\"\nduration = {}\nradius = {}\npitch = {}\n", helix.duration,
                                helix.radius, helix.pitch);
  const auto angle = [&](const char* name, double& value) {
    const bool degrees = dice.chance(0.5);
    const double written = dice.uniform(-3, 3) * (degrees ? 60 : 1);
    value = degrees ? inRadians(written) : written;
    out += fmt::format("{}{} = {}\n", name, degrees ? "_deg" : "", written);
  };
  angle("start_angle", helix.start_angle);
  angle("end_angle", helix.end_angle);
  if (dice.chance(0.5)) angle("phase", helix.phase);
  if (dice.chance(0.5)) angle("height_phase", helix.height_phase);
  const std::pair<const char*, double*> rates[] = {{"start_rate", &helix.start_rate},
                                                   {"end_rate", &helix.end_rate},
                                                   {"start_acceleration", &helix.start_acceleration},
                                                   {"end_acceleration", &helix.end_acceleration}};
  for (const auto& [name, value] : rates)
    if (dice.chance(0.5)) out += fmt::format("{} = {}\n", name, *value = dice.uniform(-1, 1));
  return out;
}

TimedPose poseAt(const Trajectory& trajectory, double t) {
  const Motion<double> motion = trajectory.at(t);
  const Eigen::Quaterniond q = Eigen::Quaterniond(motion.Q).normalized();
  return {t, motion.p, {q.w(), q.x(), q.y(), q.z()}};
}

void writeTable(const std::vector<TimedPose>& poses, const std::filesystem::path& file) {
  std::ofstream table(file);
  table << "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n";
  for (const TimedPose& pose : poses)
    table << fmt::format("{},{},{}\n", pose.time, fmt::join(pose.position.data(), pose.position.data() + 3, ", "),
                         fmt::join(pose.orientation.data(), pose.orientation.data() + 4, ","));
}

/// Replaces the trajectory by that of the numbers that are written.
std::string trajectoryText(WrittenScenario& out, std::uint64_t seed, const std::filesystem::path& folder) {
  const std::shared_ptr<const Trajectory> given = out.states.trajectory;
  const std::string kind = given->kind();
  if (kind == "helix") {
    HelixParameters helix;
    helix.duration = given->duration();
    const std::string text = helixText(seed, helix);
    out.states.trajectory = makeHelix(helix);
    return text;
  }
  out.in_degrees = kind != "samples" && seed % 2 == 0;
  std::string text = fmt::format("kind = \"{}\"\n", kind);
  if (kind == "hold") {
    const TimedPose pose = poseAt(*given, 0);
    out.states.trajectory = makeHold(pose.position, pose.orientation, given->duration());
    return text + fmt::format("duration = {}\n{}\n", given->duration(), poseText(pose, out.in_degrees, "\n"));
  }
  std::vector<TimedPose> poses;
  for (const double t : given->knots()) poses.push_back(poseAt(*given, t));
  if (kind == "samples") {
    out.states.trajectory = makeSamples(poses);
    writeTable(poses, folder / "samples.csv");
    return text + "file = \"samples.csv\"\n";
  }
  out.states.trajectory = makeWaypoints(poses);
  text += "points = [\n";
  for (const TimedPose& pose : poses)
    text += fmt::format("  {{ time = {}, {} }},\n", pose.time, poseText(pose, out.in_degrees, ", "));
  return text + "]\n";
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

WrittenScenario asText(const Scenario& scenario, std::uint64_t seed, const std::filesystem::path& folder) {
  WrittenScenario out{"name = \"random\"\n\n", scenario};
  ManipulatorParameters machine = scenario.manipulator->given();
  for (Leg& leg : machine.legs) leg.coulomb.sliding_speed = leg.coulomb.smoothing_speed;  // a file has one number
  out.states.manipulator = std::make_shared<const Manipulator>(machine);
  out.text += machineText(machine, seed) + "\n[trajectory]\n";
  out.text += trajectoryText(out, seed, folder);
  if (scenario.load) out.text += loadText(*scenario.load, seed, folder);
  return out;
}

}  // namespace ursula
