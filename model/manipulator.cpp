#include "model/manipulator.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/errors.h"

namespace ursula {
namespace {

std::string text(const Vector3d& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

/// Prints six digits, or all of them if six do not tell the value from the bound.
std::string computed(double value, double bound) {
  const std::string text = fmt::format("{:.6g}", value);
  return value != bound && text == fmt::format("{:.6g}", bound) ? fmt::format("{}", value) : text;
}

void requireFinite(const std::string& place, const Vector3d& v) {
  if (!v.allFinite()) throw InvalidParameter(place, text(v), "finite numbers");
}

void requireFinite(const std::string& place, double value) {
  if (!std::isfinite(value)) throw InvalidParameter(place, fmt::format("{}", value), "a finite number");
}

void requirePositive(const std::string& place, double value) {
  requireFinite(place, value);
  if (!(value > 0)) throw InvalidParameter(place, fmt::format("{}", value), "> 0");
}

void requireNotNegative(const std::string& place, double value) {
  requireFinite(place, value);
  if (!(value >= 0)) throw InvalidParameter(place, fmt::format("{}", value), ">= 0");
}

/// Returns whether the tensor is that of a thin rod: zero about the principal axis `line`, positive about those across
/// it.
bool isRod(const Matrix3d& I, int line) {
  const int x = (line + 1) % 3, y = (line + 2) % 3;
  return I.col(line).isZero(0) && I(x, x) > 0 && I(y, y) > 0;
}

/// Requires that some body can have the tensor: its principal moments are positive and none exceeds the sum of the
/// other two (Wittenburg, Dynamics of Multibody Systems, 2nd ed., sect. 3.1); equality means a lamina. A rod along the
/// axis `line`, if given, may have one zero moment.
void requireInertia(const std::string& place, const Matrix3d& inertia, int line = -1) {
  if (!inertia.allFinite()) throw InvalidParameter(place, "a non-finite entry", "finite numbers");
  if (!(inertia - inertia.transpose()).isZero(0)) throw InvalidParameter(place, "not symmetric", "a symmetric tensor");
  const Vector3d moments = Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  const double sum = moments(0) + moments(1);
  const std::string value =
      fmt::format("principal moments [{:.6g}, {:.6g}, {}]", moments(0), moments(1), computed(moments(2), sum));
  // The eigenvalues are accurate to a few eps of the largest.
  const double rounding = 16 * Eigen::NumTraits<double>::epsilon() * moments.cwiseAbs().maxCoeff();
  if (!(moments(0) > 0) && !(line >= 0 && isRod(inertia, line)))
    throw InvalidParameter(
        place, value,
        line < 0 ? "all principal moments > 0" : "all principal moments > 0, or of a thin rod that about its line = 0");
  if (!(moments(2) <= sum + rounding))
    throw InvalidParameter(
        place, value,
        fmt::format("the largest principal moment <= the sum of the others, {}", computed(sum, moments(2))));
}

/// A link without mass has no inertia either, and no mass centre that matters.
void requireLink(const std::string& place, const Link& link, int line) {
  requireNotNegative(place + ".mass", link.mass);
  requireFinite(place + ".center_of_mass", link.center_of_mass);
  requireFinite(place + ".center_of_mass", link.off_line);
  if (link.off_line(line) != 0)
    throw InvalidParameter(place + ".center_of_mass", text(link.off_line), "an offset across the link's line");
  if (link.mass > 0)
    requireInertia(place + ".inertia", link.inertia, line);
  else if (!link.inertia.isZero(0))
    throw InvalidParameter(place + ".inertia", text(link.inertia.diagonal()), "zero, as the link's mass is 0");
}

void requireNoneNegative(const std::string& place, const JointFriction& friction) {
  for (std::size_t k = 0; k < coordinate_count; ++k) {
    const auto coordinate = static_cast<Coordinate>(k);
    requireNotNegative(place + "." + nameOf(coordinate), friction.on(coordinate));
  }
}

/// A link's spin may be ignored only if the link is round and nothing else depends on the spin.
void requireRound(const std::string& place, const Link& link) {
  const Matrix3d& I = link.inertia;
  const std::string tensor =
      fmt::format("xx = {}, yy = {}, products {}", I(0, 0), I(1, 1), text({I(0, 1), I(0, 2), I(1, 2)}));
  if (I(0, 0) != I(1, 1) || I(0, 1) != 0 || I(0, 2) != 0 || I(1, 2) != 0)
    throw InvalidParameter(place + ".inertia", tensor, "xx = yy and no products, as the leg's spin is \"free\"");
  if (!link.off_line.isZero(0))
    throw InvalidParameter(place + ".center_of_mass", text(link.off_line),
                           "a mass centre on the line, as the leg's spin is \"free\"");
}

void requireSpin(const std::string& place, const Leg& leg) {
  if (!leg.spins) return;
  if (leg.kind == LegKind::URS)
    throw InvalidParameter(place + ".spin", "\"free\" of a URS leg",
                           "\"held\": its links cannot turn about their lines");
  if (rowOf(leg.kind).isTelescopic()) requireRound(place + ".proximal", leg.proximal);
  requireRound(place + ".distal", leg.distal);
}

void requireRotors(const std::string& place, const Leg& leg) {
  requireNoneNegative(place + ".rotor_inertia", leg.rotor_inertia);
  for (std::size_t k = 0; k < coordinate_count; ++k) {
    const auto coordinate = static_cast<Coordinate>(k);
    const double rotor = leg.rotor_inertia.on(coordinate);
    if (rotor != 0 && !leg.drives(coordinate))
      throw InvalidParameter(place + ".rotor_inertia." + nameOf(coordinate), fmt::format("{}", rotor),
                             fmt::format("0, as no motor drives {} of this leg", nameOf(coordinate)));
  }
}

std::string legPlace(int i) { return fmt::format("manipulator.leg[{}]", i + 1); }

void requireLeg(const std::string& place, const Leg& leg) {
  requireFinite(place + ".base_point", leg.base_point);
  requireFinite(place + ".base_axis", leg.base_axis);
  if (!(leg.base_axis.stableNorm() > 0))
    throw InvalidParameter(place + ".base_axis", text(leg.base_axis), "a vector that is not zero");
  requireFinite(place + ".platform_point", leg.platform_point);
  if (rowOf(leg.kind).hasCarriage())  // a carriage's length is for drawing only
    requireNotNegative(place + ".proximal.length", leg.proximal.length);
  else
    requirePositive(place + ".proximal.length", leg.proximal.length);
  requirePositive(place + ".distal.length", leg.distal.length);
  requireLink(place + ".proximal", leg.proximal, leg.proximalLine());
  requireLink(place + ".distal", leg.distal, 2);
  requireSpin(place, leg);
  requireRotors(place, leg);
  requireNoneNegative(place + ".friction", leg.friction);
  requireNoneNegative(place + ".coulomb", leg.coulomb);
  requirePositive(place + ".coulomb.smoothing_speed", leg.coulomb.smoothing_speed);
  requirePositive(place + ".coulomb.smoothing_speed", leg.coulomb.sliding_speed);
}

void requireLegCount(const ManipulatorParameters& machine) {
  const std::size_t legs = machine.legs.size();
  if (legs < 3 || legs > leg_count) throw InvalidParameter("manipulator.leg", fmt::format("{} legs", legs), "3 to 6");
}

Motors motorsOf(const ManipulatorParameters& machine) {
  Motors out;
  std::size_t count = 0;
  for (std::size_t i = 0; i < machine.legs.size(); ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (!machine.legs[i].actuated[j]) continue;
      if (count < out.size())
        out[count] = {static_cast<int>(i), static_cast<int>(j), rowOf(machine.legs[i].kind).coordinates[j]};
      ++count;
    }
  if (count != out.size())
    throw InvalidParameter("manipulator.leg",
                           fmt::format("{} actuated coordinates of {} legs in all", count, machine.legs.size()),
                           machine.legs.size() < leg_count && count < out.size()
                               ? "exactly 6: is a leg missing, or a motor in its 'actuated'?"
                               : "exactly 6");
  return out;
}

/// Two legs and the platform edge between them must span the base edge in any pose, and vice versa.
void requireSpan(const ManipulatorParameters& machine, int i, int j) {
  const Leg& first = machine.legs[i];
  const Leg& second = machine.legs[j];
  if (rowOf(first.kind).hasCarriage() || rowOf(second.kind).hasCarriage()) return;  // rails have no end
  const double base = (first.base_point - second.base_point).norm();
  const double platform = (first.platform_point - second.platform_point).norm();
  const double reach = first.proximal.length + first.distal.length + second.proximal.length + second.distal.length;
  const double gap = std::abs(base - platform);
  if (reach >= gap) return;
  // A base or platform so much larger than the leg is probably given in millimetres.
  const bool is_mm = gap > 50 * reach;
  const char* point = base > platform ? ".base_point" : ".platform_point";
  throw InvalidParameter(
      legPlace(i) + (is_mm ? point : ""),
      fmt::format("l + s of legs {} and {} together {} m", i + 1, j + 1, computed(reach, gap)),
      fmt::format(">= {} m, by which their base and platform distances differ{}", computed(gap, reach),
                  is_mm ? fmt::format(", did you mean mm? {:.6g} mm are {:.6g} m", gap, gap / 1000) : ""));
}

}  // namespace

double& PerCoordinate::on(Coordinate coordinate) {
  switch (coordinate) {
    case Coordinate::phi:
      return phi;
    case Coordinate::psi:
      return psi;
    case Coordinate::theta:
      return theta;
    case Coordinate::d:
      break;
  }
  return d;
}

bool Leg::drives(Coordinate coordinate) const {
  const auto& has = rowOf(kind).coordinates;
  for (std::size_t j = 0; j < has.size(); ++j)
    if (has[j] == coordinate) return actuated[j];
  return false;
}

Manipulator::Manipulator(const ManipulatorParameters& parameters) : given_(parameters), parameters_(parameters) {
  requireLegCount(parameters_);
  requireFinite("manipulator.gravity", parameters_.gravity);
  requirePositive("manipulator.platform.mass", parameters_.platform.mass);
  requireFinite("manipulator.platform.center_of_mass", parameters_.platform.center_of_mass);
  requireInertia("manipulator.platform.inertia", parameters_.platform.inertia);
  for (int i = 0; i < legCount(); ++i) requireLeg(legPlace(i), leg(i));
  for (int i = 0; i < legCount(); ++i)
    for (int j = i + 1; j < legCount(); ++j) requireSpan(parameters_, i, j);
  motors_ = motorsOf(parameters_);
  for (Leg& leg : parameters_.legs) {
    if (!leg.spins) continue;
    leg.distal.inertia(2, 2) = 0;
    if (rowOf(leg.kind).isTelescopic()) leg.proximal.inertia(2, 2) = 0;
  }
}

bool Manipulator::isOfThePaper() const {
  if (legCount() != leg_count) return false;
  for (const Leg& leg : parameters_.legs)
    if (leg.kind != LegKind::URS || leg.actuated != std::array<bool, 3>{true, false, false}) return false;
  return true;
}

bool hasRotors(const Manipulator& manipulator) {
  const auto& legs = manipulator.parameters().legs;
  return std::any_of(legs.begin(), legs.end(), [](const Leg& leg) { return leg.rotor_inertia.any(); });
}

Manipulator frictionless(const Manipulator& manipulator) {
  ManipulatorParameters machine = manipulator.parameters();
  for (Leg& leg : machine.legs) {
    leg.friction = {};
    leg.coulomb = {};
  }
  return Manipulator(machine);
}

}  // namespace ursula
