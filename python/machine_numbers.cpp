#include "python/machine_numbers.h"

#include <string>
#include <utility>

namespace ursula::python {
namespace py = pybind11;
namespace {

template <class... Fields>
py::object record(Fields&&... fields) {
  return py::module_::import("types").attr("SimpleNamespace")(std::forward<Fields>(fields)...);
}

py::array_t<double> tensorOf(const Matrix3d& I) { return py::array_t<double>({3, 3}, {8, 24}, I.data()); }

py::object linkOf(const Link& link) {
  using namespace py::literals;
  return record("length"_a = link.length, "mass"_a = link.mass, "center_of_mass"_a = link.center_of_mass,
                "off_line"_a = vectorOf(link.off_line.data(), 3), "inertia"_a = tensorOf(link.inertia));
}

/// The coordinates that the leg has.
py::dict perCoordinate(const Leg& leg, const PerCoordinate& values) {
  py::dict out;
  for (const Coordinate each : rowOf(leg.kind).coordinates) out[nameOf(each)] = values.on(each);
  return out;
}

py::object legOf(const Leg& leg) {
  using namespace py::literals;
  py::list actuated;
  for (const Coordinate each : rowOf(leg.kind).coordinates)
    if (leg.drives(each)) actuated.append(nameOf(each));
  return record("kind"_a = std::string(rowOf(leg.kind).name), "base_point"_a = vectorOf(leg.base_point.data(), 3),
                "base_axis"_a = vectorOf(Vector3d(leg.base_axis.stableNormalized()).data(), 3),
                "platform_point"_a = vectorOf(leg.platform_point.data(), 3), "proximal"_a = linkOf(leg.proximal),
                "distal"_a = linkOf(leg.distal), "knee"_a = leg.knee == Knee::positive ? "positive" : "negative",
                "actuated"_a = actuated, "spin"_a = leg.spins ? "free" : "held",
                "friction"_a = perCoordinate(leg, leg.friction), "coulomb"_a = perCoordinate(leg, leg.coulomb),
                "smoothing_speed"_a = leg.coulomb.smoothing_speed,
                "rotor_inertia"_a = perCoordinate(leg, leg.rotor_inertia));
}

}  // namespace

py::list legsOf(const ManipulatorParameters& machine) {
  py::list out;
  for (const Leg& leg : machine.legs) out.append(legOf(leg));
  return out;
}

py::object platformOf(const ManipulatorParameters& machine) {
  using namespace py::literals;
  const Platform& platform = machine.platform;
  return record("mass"_a = platform.mass, "center_of_mass"_a = vectorOf(platform.center_of_mass.data(), 3),
                "inertia"_a = tensorOf(platform.inertia));
}

}  // namespace ursula::python
