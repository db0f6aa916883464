#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <ursula/scenario.h>

#include <vector>

namespace ursula::python {

/// Commanded states at N instants; what Python sees are views of these rows.
struct Motions {
  std::vector<Motion<double>> rows;
};

/// N × width, row by row, from `at(row, out)`.
template <class Rows, class F>
pybind11::array_t<double> table(const Rows& rows, pybind11::ssize_t width, F&& at) {
  pybind11::array_t<double> out({static_cast<pybind11::ssize_t>(rows.size()), width});
  double* to = out.mutable_data();
  for (const auto& row : rows) {
    at(row, to);
    to += width;
  }
  return out;
}

/// `values` as N × width doubles. Throws ValueError that names `what` for another shape or no numbers.
pybind11::array_t<double> rowsOf(const pybind11::handle& values, pybind11::ssize_t width, const char* what);

/// The same for numbers one a row; a single number is one row.
pybind11::array_t<double> columnOf(const pybind11::handle& values, const char* what);

void addMotion(pybind11::module_& module);

}  // namespace ursula::python
