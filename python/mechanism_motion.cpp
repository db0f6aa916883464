#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "python/archive.h"
#include "python/bindings.h"
#include "python/mechanism.h"
#include "python/motion.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

using Rows = MechanismMotion::Rows;

constexpr py::ssize_t size = sizeof(double);

auto matrix(Rows MechanismMotion::*which) {
  return [which](const py::object& self) {
    const Rows& rows = self.cast<const MechanismMotion&>().*which;
    return view(self, rows.data(), {rows.rows(), rows.cols()}, {rows.cols() * size, size});
  };
}

/// The columns of the other joints, by name.
auto columns(Rows MechanismMotion::*which) {
  return [which](const py::object& self) {
    const MechanismMotion& motion = self.cast<const MechanismMotion&>();
    const Rows& rows = motion.*which;
    py::dict out;
    for (Eigen::Index k = 0; k < rows.cols(); ++k)
      out[py::str(motion.names[k])] = view(self, rows.data() + k, {rows.rows()}, {rows.cols() * size});
    return out;
  };
}

template <class Which>
MechanismMotion chosen(const MechanismMotion& motion, const Which& which) {
  const std::vector<std::size_t> rows = pickedRows(motion.t.size(), which);
  MechanismMotion out = MechanismMotion::of(static_cast<Eigen::Index>(rows.size()), motion.q.cols(), motion.names);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto to = static_cast<Eigen::Index>(k), from = static_cast<Eigen::Index>(rows[k]);
    out.t(to) = motion.t(from);
    for (Rows MechanismMotion::*each :
         {&MechanismMotion::q, &MechanismMotion::qdot, &MechanismMotion::qddot, &MechanismMotion::joints,
          &MechanismMotion::joint_rates, &MechanismMotion::joint_accelerations})
      (out.*each).row(to) = (motion.*each).row(from);
  }
  return out;
}

py::array_t<double> copyOf(const Rows& rows) { return py::array_t<double>({rows.rows(), rows.cols()}, rows.data()); }

Rows rowsOfArray(const py::handle& array) {
  const auto given = array.cast<py::array_t<double, py::array::c_style | py::array::forcecast>>();
  return Eigen::Map<const Rows>(given.data(), given.shape(0), given.shape(1));
}

py::tuple stateOf(const MechanismMotion& self) {
  return py::make_tuple(copyOf(Rows(self.t)), copyOf(self.q), copyOf(self.qdot), copyOf(self.qddot), self.names,
                        copyOf(self.joints), copyOf(self.joint_rates), copyOf(self.joint_accelerations));
}

MechanismMotion ofState(const py::tuple& state) {
  return {rowsOfArray(state[0]),
          rowsOfArray(state[1]),
          rowsOfArray(state[2]),
          rowsOfArray(state[3]),
          state[4].cast<std::vector<std::string>>(),
          rowsOfArray(state[5]),
          rowsOfArray(state[6]),
          rowsOfArray(state[7])};
}

}  // namespace

MechanismMotion MechanismMotion::of(Eigen::Index count, Eigen::Index motors, std::vector<std::string> names) {
  MechanismMotion out;
  const auto others = static_cast<Eigen::Index>(names.size());
  out.t.setZero(count);
  for (Rows* each : {&out.q, &out.qdot, &out.qddot}) each->setZero(count, motors);
  for (Rows* each : {&out.joints, &out.joint_rates, &out.joint_accelerations}) each->setZero(count, others);
  out.names = std::move(names);
  return out;
}

void MechanismMotion::set(Eigen::Index row, const MotorMotion& motors,
                          const std::vector<LoopSolver::JointValue>& others) {
  t(row) = motors.t;
  q.row(row) = motors.q;
  qdot.row(row) = motors.qdot;
  qddot.row(row) = motors.qddot;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    joints(row, column) = others[k].value;
    joint_rates(row, column) = others[k].rate;
    joint_accelerations(row, column) = others[k].acceleration;
  }
}

void addMechanismMotion(py::module_& module) {
  using M = MechanismMotion;
  py::class_<M> motion(module, "MechanismMotion", words::mechanism_motion);
  addCopies(motion);
  motion.def(py::pickle(&stateOf, &ofState))
      .def_property_readonly(
          "t",
          [](const py::object& self) {
            const M& motion = self.cast<const M&>();
            return view(self, motion.t.data(), {motion.t.size()}, {size});
          },
          "Instants, s: (N,).")
      .def_property_readonly("q", matrix(&M::q), "Coordinates of the motors, rad or m: (N, n).")
      .def_property_readonly("qdot", matrix(&M::qdot), "Their rates, rad/s or m/s: (N, n).")
      .def_property_readonly("qddot", matrix(&M::qddot), "Their accelerations, rad/s² or m/s²: (N, n).")
      .def_property_readonly("joints", columns(&M::joints), words::joints)
      .def_property_readonly("joint_rates", columns(&M::joint_rates), "Their rates, by the same names: each (N,).")
      .def_property_readonly("joint_accelerations", columns(&M::joint_accelerations),
                             "Their accelerations, by the same names: each (N,).")
      .def("__len__", [](const M& motion) { return motion.t.size(); })
      .def("__getitem__", &chosen<py::ssize_t>, py::arg("row"))
      .def("__getitem__", &chosen<py::slice>, py::arg("rows"))
      .def("__repr__", [](const M& motion) {
        const Eigen::Index count = motion.t.size();
        return "<ursula.MechanismMotion of " + std::to_string(count) + (count == 1 ? " instant>" : " instants>");
      });
}

}  // namespace ursula::python
