#include "python/bindings.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <ursula/validate.h>

#include <Eigen/Geometry>
#include <array>
#include <utility>

#include "python/motion.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

using Block = EffortsByState::Block;
using Rows = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;

/// Returns the derivative of the load at P by a rotation of the platform, through the load's frame and its point.
Block loadByTurn(const Load* load, const Motion<double>& motion, const Vector6d& at_P) {
  Block out = Block::Zero();
  if (load == nullptr) return out;
  const Vector3d moment = at_P.head<3>(), force = at_P.tail<3>(), point = motion.Q * load->point;
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = Vector3d::Unit(k);
    if (load->frame == Load::Frame::platform)
      out.col(k) << axis.cross(moment), axis.cross(force);
    else
      out.col(k).head<3>() = axis.cross(point).cross(force);
  }
  return out;
}

/// Returns N × 6 × width from `of(k)`, 6 × width.
template <class F>
py::array_t<double> blocks(const Motions& motion, py::ssize_t width, F&& of) {
  py::array_t<double> out({static_cast<py::ssize_t>(motion.rows.size()), py::ssize_t{6}, width});
  double* to = out.mutable_data();
  const Unlocked unlocked;
  forRows(motion.rows.size(),
          [&](std::size_t k) { Eigen::Map<Rows>(to + 6 * width * k, 6, width) = of(motion.rows[k]); });
  return out;
}

py::dict effortDerivatives(const ScenarioWithSolver& self, const Motions& motion) {
  const Load* load = self.scenario.load.get();
  const py::array_t<double> all = blocks(motion, 18, [&](const Motion<double>& row) {
    const Vector6d at_P = loadAtP(load, row);
    return self.derivatives.byState(row, at_P, loadByTurn(load, row, at_P)).derivatives;
  });
  py::dict out;
  constexpr std::array<const char*, 6> names = {"orientation", "p", "w", "v", "alpha", "a"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto first = static_cast<py::ssize_t>(3 * k);
    out[names[k]] = all[py::make_tuple(py::ellipsis(), py::slice(first, first + 3, 1))];
  }
  return out;
}

py::tuple parameterDerivatives(const ScenarioWithSolver& self, const Motions& motion) {
  const auto& names = self.derivatives.parameterNames();
  const Load* load = self.scenario.load.get();
  return py::make_tuple(names, blocks(motion, static_cast<py::ssize_t>(names.size()), [&](const Motion<double>& row) {
                          return self.derivatives.byParameters(row, loadAtP(load, row));
                        }));
}

py::tuple regressor(const ScenarioWithSolver& self, const Motions& motion) {
  const auto& names = self.derivatives.regressorNames();
  const Eigen::VectorXd values = self.derivatives.regressorValues();
  return py::make_tuple(names, py::array_t<double>(values.size(), values.data()),
                        blocks(motion, static_cast<py::ssize_t>(names.size()),
                               [&](const Motion<double>& row) { return self.derivatives.regressor(row); }));
}

}  // namespace

void addDerivatives(ScenarioClass& scenario) {
  scenario.def("effort_derivatives", &effortDerivatives, py::arg("m"), words::effort_derivatives)
      .def("parameter_derivatives", &parameterDerivatives, py::arg("m"), words::parameter_derivatives)
      .def("regressor", &regressor, py::arg("m"), words::regressor);
}

}  // namespace ursula::python
