#include "exchange/scenario_text.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "base/text.h"

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

/// "{ phi = 0.1, d = 2.0 }": the non-zero values by coordinate, then `more`; "" if all are zero.
std::string byCoordinate(const ImportedLeg& leg, const std::array<double, 3>& values, const std::string& more) {
  std::string out;
  const auto coordinates = rowOf(leg.kind).coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    if (values[k] != 0)
      out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", nameOf(coordinates[k]), text(values[k]));
  return out.empty() ? "" : "{ " + out + more + " }";
}

std::string centre(const ImportedLink& link, bool carriage) {
  const Vector3d& c = link.center_of_mass;
  const double along = carriage ? c.y() : c.z();
  const bool on_line = c.x() == 0 && (carriage ? c.z() : c.y()) == 0;
  return on_line ? text(along) : list(c);
}

std::string linkText(const char* name, const ImportedLink& link, bool carriage) {
  return fmt::format("{} = {{ {}mass = {}, center_of_mass = {}, inertia = {} }}  # {}\n", name,
                     carriage ? "" : "length = " + text(link.length) + ", ", text(link.mass), centre(link, carriage),
                     tensor(link.inertia), shown(link.bodies));
}

std::string actuated(const ImportedLeg& leg) {
  std::string out;
  const auto coordinates = rowOf(leg.kind).coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    if (leg.actuated[k]) out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", nameOf(coordinates[k]));
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
  out += linkText("proximal", leg.proximal, row.hasCarriage());
  out += linkText("distal", leg.distal, false);
  if (row.knee != nullptr)
    out += fmt::format("knee = \"{}\"  # sign of {} at the file's initial pose\n",
                       leg.knee_positive ? "positive" : "negative", row.knee);
  if (leg.free_spin) out += "spin = \"free\"\n";
  const std::string smoothing = leg.smoothing_speed > 0 ? ", smoothing_speed = " + text(leg.smoothing_speed) : "";
  for (const auto& [key, values, more] :
       {std::tuple("friction", leg.damping, std::string()), std::tuple("coulomb", leg.friction, smoothing),
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
  for (const ImportedPose& pose : machine.motion) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(pose.orientation).normalized();
    const double sign = q.w() < 0 ? -1 : 1;
    out += fmt::format("  {{ time = {}, position = {}, orientation = {} }},\n", text(pose.time), list(pose.position),
                       list(Eigen::Vector4d(sign * Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()))));
  }
  return out + "]\n";
}

}  // namespace

std::string motorsOf(const ImportedMachine& machine) {
  std::string out;
  for (const ImportedLeg& leg : machine.legs)
    for (const std::string& motor : leg.motors) out += (out.empty() ? "" : ", ") + motor;
  return out;
}

std::string scenarioText(const ImportedMachine& machine, const std::string& file) {
  std::string out = fmt::format("# Made by `ursula import` from {}. SI units: m, kg, s, N, rad.\n", shown(file, 200));
  out +=
      fmt::format("# B is {}; M is the frame of {}. Lengths are between the joints' centres.\n",
                  machine.base.empty() ? "the world" : "the frame of " + shown(machine.base), shown(machine.platform));
  out += fmt::format("# Effort columns 1, 2, …: {}.\n", shown(motorsOf(machine), 1000));
  out += "# Assumptions of the import:\n";
  if (machine.assumptions.empty()) out += "#   none\n";
  for (const Assumption& each : machine.assumptions)
    out += fmt::format("#   {}: {} ({:.4g} {})\n", shown(each.where, 200), shown(each.what, 300), each.size, each.unit);
  out += fmt::format("name = \"{}\"\n\n[manipulator]\ngravity = {}\n", plainName(machine.name), list(machine.gravity));
  out += fmt::format("\n[manipulator.platform]  # {}\nmass = {}\ncenter_of_mass = {}\ninertia = {}\n",
                     shown(machine.platform), text(machine.platform_mass), list(machine.platform_center),
                     tensor(machine.platform_inertia));
  for (const ImportedLeg& leg : machine.legs) out += legText(leg);
  return out + motionText(machine);
}

}  // namespace ursula::exchange
