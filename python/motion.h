#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <ursula/scenario.h>

#include <string>
#include <vector>

#include "python/made.h"
#include "python/signals.h"

namespace ursula::python {

/// Commanded states at N instants; Python sees views of these rows.
struct Motions {
  std::vector<Motion<double>> rows;
};

/// A read-only view of the numbers from `first` on, in bytes of strides; it keeps `self`, which has them, alive.
pybind11::array view(const pybind11::object& self, const double* first, std::vector<pybind11::ssize_t> shape,
                     std::vector<pybind11::ssize_t> strides);

/// Converts `values` to an array of integers or floats, without a copy if they are one. Throws ValueError that begins
/// with `what` for text, dates, complex numbers, objects, and masked arrays, because masks would be ignored. NumPy's
/// own errors pass unchanged.
pybind11::array numbersIn(const pybind11::object& values, const std::string& what);

/// Fills N × width values row by row with `at(row, out)`.
template <class Rows, class F>
pybind11::array_t<double> table(const Rows& rows, pybind11::ssize_t width, F&& at) {
  pybind11::array_t<double> out({static_cast<pybind11::ssize_t>(rows.size()), width});
  double* to = out.mutable_data();
  forRows(rows.size(), [&](std::size_t k) { at(rows[k], to + width * k); });
  return out;
}

/// Converts `values` to N × width doubles. Throws ValueError with `what` for another shape, for non-numbers, and for
/// values that are not finite.
pybind11::array_t<double> rowsOf(const pybind11::object& values, pybind11::ssize_t width, const char* what);

/// The same with one number per row; a single number is one row.
pybind11::array_t<double> columnOf(const pybind11::object& values, const char* what);

/// Throws ValueError for an instant outside the motion. A few roundings beyond its end are accepted, as in the last
/// value of numpy.arange(0, duration + step, step).
void refuseOutside(const pybind11::array_t<double>& instants, double duration);

void addMotion(pybind11::module_& module);

}  // namespace ursula::python
