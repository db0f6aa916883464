#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "validation/check_scenario/check_scenario.h"

namespace ursula {
namespace {

std::string legKey(int i, const std::string& key) { return fmt::format("manipulator.leg[{}].{}", i + 1, key); }

double largestMoment(const Matrix3d& inertia) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues()(2);
}

/// The size of the base or the platform: the largest distance of a point from the mean of all.
template <class Point>
double extent(const ManipulatorParameters& machine, Point&& point) {
  Vector3d mean = Vector3d::Zero();
  for (const Leg& leg : machine.legs) mean += point(leg) / static_cast<double>(machine.legs.size());
  double far = 0;
  for (const Leg& leg : machine.legs) far = std::max(far, (point(leg) - mean).norm());
  return far;
}

/// On Earth g is between 9.764 and 9.834 m/s².
void gravity(const Vector3d& g, std::vector<Oddity>& out) {
  const double size = g.norm();
  if (g.z() > 0.5 * size)
    out.push_back({"manipulator.gravity", fmt::format("its z is {:+.6g} m/s2: it points up along +z of the base. Usual "
                                                      "is [0, 0, -9.81], unless the machine hangs",
                                                      g.z())});
  if (size > 0 && !(size > 9.76 && size < 9.84))
    out.push_back(
        {"manipulator.gravity", fmt::format("is {:.6g} m/s2 in size, on Earth it is 9.76 to 9.84 m/s2{}", size,
                                            size > 9000 && size < 10000 ? ": was it given in mm/s2?" : "")});
}

/// A slender link with mass within [0, l] and centre c has at most m c (l − c) about that centre, if all mass is at
/// both ends. Its width adds to it; a twentieth of the length is tolerated.
void linkInertia(const Link& link, const std::string& key, std::vector<Oddity>& out) {
  const double l = link.length, c = std::clamp(link.center_of_mass, 0.0, l), moment = largestMoment(link.inertia);
  const double most = link.mass * (c * (l - c) + l * l / 20), gyration = std::sqrt(moment / link.mass);
  const double about_joint = moment - link.mass * c * c;
  if (moment > most)
    out.push_back({key + ".inertia", fmt::format("{:.6g} kg m2 is more than {:.6g} kg can have within a link of {:.6g} "
                                                 "m with its mass centre at {:.6g} m: at most about {:.3g} kg m2{}",
                                                 moment, link.mass, l, link.center_of_mass, most,
                                                 about_joint > 0 && about_joint <= most
                                                     ? ". Is it about the joint? Expected is that about the mass centre"
                                                     : "")});
  else if (gyration < 1e-3 * l)
    out.push_back(
        {key + ".inertia",
         fmt::format(
             "{:.3g} kg m2 has all of {:.6g} kg within {:.3g} m, of a link of {:.6g} m. Was it given in other units?",
             moment, link.mass, gyration, l)});
  const double along = link.inertia(2, 2), across = std::min(link.inertia(0, 0), link.inertia(1, 1));
  if (along > 1.001 * across)
    out.push_back({key + ".inertia", fmt::format("its third entry, {:.6g} kg m2, is about the link's own direction and "
                                                 "is larger than {:.6g} kg m2 across it: of a link it is the smallest",
                                                 along, across)});
}

void link(const Link& link, const std::string& key, std::vector<Oddity>& out) {
  if (!(link.center_of_mass >= 0 && link.center_of_mass <= link.length))
    out.push_back({key + ".center_of_mass",
                   fmt::format("{:.6g} m is {} the link, which reaches from 0 to {:.6g} m", link.center_of_mass,
                               link.center_of_mass < 0 ? "before" : "beyond", link.length)});
  linkInertia(link, key, out);
}

void legs(const ManipulatorParameters& machine, std::vector<Oddity>& out) {
  const double base = extent(machine, [](const Leg& leg) { return leg.base_point; });
  for (int i = 0; i < static_cast<int>(machine.legs.size()); ++i) {
    const Leg& leg = machine.legs[i];
    if (!rowOf(leg.kind).hasCarriage())
      link(leg.proximal, legKey(i, "proximal"), out);  // a carriage has no length and never turns
    link(leg.distal, legKey(i, "distal"), out);
    if (const double size = leg.base_axis.norm(); std::abs(size - 1) > 0.01)
      out.push_back(
          {legKey(i, "base_axis"),
           fmt::format("is {:.6g} long and gets normalised; a direction is usually given with length 1", size)});
    if (const double far = leg.platform_point.norm(); far > 3 * base)
      out.push_back(
          {legKey(i, "platform_point"),
           fmt::format(
               "is {:.6g} m from the platform's origin, while the base's points lie within {:.6g} m of their mean", far,
               base),
           far > 100 * base ? inMillimetres(far) : ""});
  }
}

void platform(const ManipulatorParameters& machine, std::vector<Oddity>& out) {
  const Platform& body = machine.platform;
  const double size = extent(machine, [](const Leg& leg) { return leg.platform_point; });
  const double moment = largestMoment(body.inertia), gyration = std::sqrt(moment / body.mass);
  const auto odd = [&](const char* key, std::string what) {
    out.push_back({std::string("manipulator.platform.") + key, std::move(what)});
  };
  if (gyration > 3 * size || gyration < 1e-3 * size)
    odd("inertia", fmt::format("{:.6g} kg m2 is that of {:.6g} kg at {:.3g} m from the mass centre, while the "
                               "platform's points lie within {:.6g} m of their mean",
                               moment, body.mass, gyration, size));
  if (const double far = body.center_of_mass.norm(); far > 5 * size)
    odd("center_of_mass",
        fmt::format(
            "is {:.6g} m from the platform's origin, while the platform's points lie within {:.6g} m of their mean",
            far, size));
}

/// Detects millimetres among metres. These differ by a factor of a thousand; lengths of real machines differ by less
/// than a hundred.
void units(const ManipulatorParameters& machine, std::vector<Oddity>& out) {
  const double base = extent(machine, [](const Leg& leg) { return leg.base_point; });
  for (int i = 0; i < static_cast<int>(machine.legs.size()); ++i) {
    const Leg& leg = machine.legs[i];
    const bool on_rail = rowOf(leg.kind).hasCarriage();
    const double first = on_rail ? 0 : leg.proximal.length, reach = first + leg.distal.length;
    const double shorter = std::min(first, leg.distal.length), longer = reach - shorter;
    const std::string which = first > leg.distal.length ? "proximal.length" : "distal.length";
    if (!on_rail && longer > 100 * shorter)
      out.push_back({legKey(i, which),
                     fmt::format("{:.6g} m, while the leg's other link is {:.6g} m long", longer, shorter),
                     inMillimetres(longer)});
    else if (reach > 100)
      out.push_back({legKey(i, which), fmt::format("the leg is {:.6g} m long", reach),
                     inMillimetres(reach) + "; ursula init NEW --from FILE --lengths mm turns all lengths into m"});
    if (base > 100 * reach)
      out.push_back({legKey(i, "base_point"),
                     fmt::format("the base's points lie within {:.6g} m of their mean, while the leg is {:.6g} m long",
                                 base, reach),
                     inMillimetres(base)});
  }
}

}  // namespace

std::string inMillimetres(double value) {
  return fmt::format("did you mean mm? {:.6g} mm are {:.6g} m", value, value / 1000);
}

std::vector<Oddity> oddMachine(const Scenario& scenario) {
  const ManipulatorParameters& machine = scenario.manipulator->parameters();
  std::vector<Oddity> out;
  gravity(machine.gravity, out);
  platform(machine, out);
  legs(machine, out);
  units(machine, out);
  return out;
}

}  // namespace ursula
