#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "base/text.h"
#include "parts/exchange/recognise/machine.h"

namespace ursula::exchange {
namespace {

std::string text(double value) {
  const std::string digits = fmt::format("{}", value == 0 ? 0.0 : value);
  return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
}

template <class Vector>
std::string list(const Vector& v) {
  std::string out;
  for (Eigen::Index k = 0; k < v.size(); ++k) out += (k == 0 ? "" : ", ") + text(v(k));
  return "[" + out + "]";
}

std::string tensor(const Matrix3d& m) {
  if (m(0, 1) == 0 && m(0, 2) == 0 && m(1, 2) == 0) return list(Vector3d(m.diagonal()));
  Vector6d entries;
  entries << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2);
  return list(entries);
}

/// Makes a name safe for a folder and for a comment's line.
std::string plainName(const std::string& name) {
  std::string out;
  for (const char c : name.substr(0, 80)) {
    const bool plain =
        (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
    out += plain ? c : '-';
  }
  return out.find_first_not_of('-') == std::string::npos ? "imported" : out;
}

/// Returns "{ phi = 0.1, d = 2.0 }": the non-zero values by coordinate, then `more`; "" if all are zero.
std::string byCoordinate(const Leg& leg, const PerCoordinate& values, const std::string& more) {
  std::string out;
  for (const Coordinate each : rowOf(leg.kind).coordinates)
    if (values.on(each) != 0)
      out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", nameOf(each), text(values.on(each)));
  return out.empty() ? "" : "{ " + out + more + " }";
}

std::string linkText(const char* name, const Link& link, const Vector3d& center, const std::string& bodies,
                     bool carriage) {
  return fmt::format("{} = {{ {}mass = {}, center_of_mass = {}, inertia = {} }}  # {}\n", name,
                     carriage ? "" : "length = " + text(link.length) + ", ", text(link.mass),
                     link.off_line.isZero(0) ? text(link.center_of_mass) : list(center), tensor(link.inertia),
                     shown(bodies));
}

std::string actuated(const Leg& leg) {
  std::string out;
  for (const Coordinate each : rowOf(leg.kind).coordinates)
    if (leg.drives(each)) out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", nameOf(each));
  return out;
}

std::string legText(const ImportedLeg& leg) {
  const LegKindRow& row = rowOf(leg.kind);
  std::string out = fmt::format("\n[[manipulator.leg]]  # joints {}\n", shown(leg.joints, 400));
  out += fmt::format("kind = \"{}\"\nactuated = [{}]\n", row.name, actuated(leg));
  out += fmt::format("base_point = {}\nbase_axis = {}\nplatform_point = {}\n", list(leg.base_point),
                     list(leg.base_axis), list(leg.platform_point));
  if (row.isTelescopic())
    out += leg.stroke_from_file ? "# The lengths are the stroke of the file's limits: rod < d < rod + cylinder.\n"
                                : "# The lengths are a stroke that was chosen: rod < d < rod + cylinder.\n";
  out += linkText("proximal", leg.proximal, leg.proximalCenter(), leg.bodies[0], row.hasCarriage());
  out += linkText("distal", leg.distal, leg.distalCenter(), leg.bodies[1], false);
  if (row.knee != nullptr)
    out += fmt::format("knee = \"{}\"  # sign of {} at the file's initial pose\n",
                       leg.knee == Knee::positive ? "positive" : "negative", row.knee);
  if (leg.spins) out += "spin = \"free\"\n";
  const std::string smoothing = leg.smoothing_speed > 0 ? ", smoothing_speed = " + text(leg.smoothing_speed) : "";
  for (const auto& [key, values, more] :
       {std::tuple("friction", leg.friction, std::string()),
        std::tuple("coulomb", static_cast<const PerCoordinate&>(leg.coulomb), smoothing),
        std::tuple("rotor_inertia", leg.rotor_inertia, std::string())})
    if (const std::string table = byCoordinate(leg, values, more); !table.empty())
      out += fmt::format("{} = {}\n", key, table);
  return out;
}

std::string motionText(const ImportedMachine& machine) {
  std::string out = fmt::format(
      "\n# From the file's initial pose along a small helix: half a turn of radius {:.4g} m, the orientation kept, "
      "since the\n"
      "# paper's helix turns its platform with its own triad. The legs can follow it; whether it is singular they do "
      "not say.\n"
      "[trajectory]\nkind = \"waypoints\"\npoints = [\n",
      machine.motion_radius);
  for (const Motion<double>& pose : machine.motion) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(pose.Q).normalized();
    const double sign = q.w() < 0 ? -1 : 1;
    out += fmt::format("  {{ time = {}, position = {}, orientation = {} }},\n", text(pose.t), list(pose.p),
                       list(Eigen::Vector4d(sign * Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()))));
  }
  return out + "]\n";
}

/// Returns "leg_1_d, leg_2_d, …": names in the file of the motors, in the order of the scenario's efforts.
std::string motorsOf(const ImportedMachine& machine) {
  std::string out;
  for (const ImportedLeg& leg : machine.legs)
    for (const std::string& motor : leg.motors) out += (out.empty() ? "" : ", ") + motor;
  return out;
}

}  // namespace

std::string scenarioText(const ImportedMachine& machine, const std::string& file) {
  std::string out = fmt::format("# Made by `ursula import` from {}. SI units: m, kg, s, N, rad.\n", shown(file, 200));
  out +=
      fmt::format("# B is {}; M is the frame of {}. Lengths are between the joints' centres.\n",
                  machine.base.empty() ? "the world" : "the frame of " + shown(machine.base), shown(machine.platform));
  out += fmt::format("# Effort columns 1, 2, …: {}.\n", shown(motorsOf(machine), 1000));
  out += "# Assumptions of the import:\n";
  if (machine.assumptions.empty()) out += "#   none\n";
  for (const Assumption& each : machine.assumptions) out += fmt::format("#   {}\n", inWords(each));
  out += fmt::format("name = \"{}\"\n\n[manipulator]\ngravity = {}\n", plainName(machine.name), list(machine.gravity));
  out += fmt::format("\n[manipulator.platform]  # {}\nmass = {}\ncenter_of_mass = {}\ninertia = {}\n",
                     shown(machine.platform), text(machine.of_platform.mass), list(machine.of_platform.center_of_mass),
                     tensor(machine.of_platform.inertia));
  for (const ImportedLeg& leg : machine.legs) out += legText(leg);
  return out + motionText(machine);
}

}  // namespace ursula::exchange
