#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <ursula/ursula.h>

// The numbers of a machine for solvers written in Python: those of the file, with what legs share in each.

namespace ursula::python {

inline pybind11::array_t<double> vectorOf(const double* from, pybind11::ssize_t count) {
  return pybind11::array_t<double>(count, from);
}

/// One namespace for each leg, SI: kind, base_point (3,), base_axis (3,) of length 1, platform_point (3,), proximal and
/// distal (length, mass, center_of_mass along the line, off_line (3,), inertia (3, 3)), knee, actuated, spin, friction,
/// coulomb and rotor_inertia by coordinate, smoothing_speed.
pybind11::list legsOf(const ManipulatorParameters& machine);

/// mass, center_of_mass (3,), inertia (3, 3) about the mass centre.
pybind11::object platformOf(const ManipulatorParameters& machine);

}  // namespace ursula::python
