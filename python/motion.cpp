#include "python/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "python/archive.h"
#include "python/bindings.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;

static void members(Archive& archive, Motion<double>& row) {
  auto& [t, p, Q, omega, p_dot, omega_dot, p_ddot] = row;
  archive(t, p, Q, omega, p_dot, omega_dot, p_ddot);
}

static void members(Archive& archive, Motions& motion) { archive(motion.rows); }

namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Throws ValueError with the entry, such as "tau[2, 1]", unless all are finite.
void refuseNotFinite(const Array& values, const char* what) {
  const double *first = values.data(), *last = first + values.size();
  const double* found = std::find_if_not(first, last, [](double value) { return std::isfinite(value); });
  if (found == last) return;
  const py::object place = py::module_::import("numpy").attr("unravel_index")(found - first, values.attr("shape"));
  std::string at;
  for (const py::handle index : place) at += (at.empty() ? "[" : ", ") + std::string(py::str(index));
  throw py::value_error(what + (at.empty() ? at : at + "]") + " is not finite");
}

bool isMasked(const py::handle& values) {
  const py::object type = py::module_::import("numpy.ma").attr("MaskedArray");
  if (py::isinstance<py::list>(values) ||
      py::isinstance<py::tuple>(values))  // in these NumPy drops masks of their items
    for (const py::handle each : values)
      if (py::isinstance(each, type)) return true;
  return py::isinstance(values, type);
}

/// Converts by the constructor of array_t, which, unlike ensure(), keeps NumPy's error.
Array numbers(const py::object& values, const char* what) {
  const Array out(numbersIn(values, std::string(what) + ": expected real numbers"));
  refuseNotFinite(out, what);
  return out;
}

std::string shapeOf(const py::array& array) { return py::str(array.attr("shape")); }

const double* dataOf(const double& value) { return &value; }
template <class Matrix>
const double* dataOf(const Matrix& value) {
  return value.data();
}

template <class Member>
auto member(Member Motion<double>::*which, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides) {
  return [=](const py::object& self) {
    static const Motion<double> none;
    const auto& rows = self.cast<const Motions&>().rows;
    std::vector<py::ssize_t> all = {static_cast<py::ssize_t>(rows.size())}, steps = {sizeof(Motion<double>)};
    all.insert(all.end(), shape.begin(), shape.end());
    steps.insert(steps.end(), strides.begin(), strides.end());
    return view(self, dataOf((rows.empty() ? none : rows.front()).*which), std::move(all), std::move(steps));
  };
}

Matrix3d orientationOf(const double* q, std::size_t row) {
  const Eigen::Quaterniond given(q[0], q[1], q[2], q[3]);
  if (!(std::abs(given.norm() - 1) <= 1e-3))
    throw py::value_error("q[" + std::to_string(row) + "]: length " + shown(given.norm()) +
                          ", expected a unit quaternion [w, x, y, z]");
  return given.normalized().toRotationMatrix();
}

/// Requires as many rows as `rows` has; missing values stay zero.
void fill(std::vector<Motion<double>>& rows, const py::object& values, Vector3d Motion<double>::*which,
          const char* what) {
  if (values.is_none()) return;
  const Array given = rowsOf(values, 3, what);
  if (static_cast<std::size_t>(given.shape(0)) != rows.size())
    throw py::value_error(std::string(what) + ": shape " + shapeOf(given) + ", expected (" +
                          std::to_string(rows.size()) + ", 3) as there are so many instants");
  forRows(rows.size(), [&](std::size_t k) { rows[k].*which = Eigen::Map<const Vector3d>(given.data() + 3 * k); });
}

Motions motionsFrom(const py::object& t, const py::object& p, const py::object& q, const py::object& v,
                    const py::object& w, const py::object& a, const py::object& alpha) {
  const Array instants = columnOf(t, "t"), orientations = rowsOf(q, 4, "q");
  Motions out;
  out.rows.resize(instants.shape(0));
  if (orientations.shape(0) != instants.shape(0))
    throw py::value_error("q: shape " + shapeOf(orientations) + ", expected as many rows as t has");
  forRows(out.rows.size(), [&](std::size_t k) {
    out.rows[k].t = instants.data()[k];
    out.rows[k].Q = orientationOf(orientations.data() + 4 * k, k);
  });
  fill(out.rows, p, &Motion<double>::p, "p");
  fill(out.rows, v, &Motion<double>::p_dot, "v");
  fill(out.rows, w, &Motion<double>::omega, "w");
  fill(out.rows, a, &Motion<double>::p_ddot, "a");
  fill(out.rows, alpha, &Motion<double>::omega_dot, "alpha");
  return out;
}

template <class Which>
Motions chosen(const Motions& motion, const Which& which) {
  Motions out;
  for (const std::size_t k : pickedRows(motion.rows.size(), which)) out.rows.push_back(motion.rows[k]);
  return out;
}

}  // namespace

std::vector<std::size_t> pickedRows(std::size_t count, py::ssize_t row) {
  const auto all = static_cast<py::ssize_t>(count);
  if (row < -all || row >= all) throw py::index_error("no such row of the motion");
  return {static_cast<std::size_t>(row < 0 ? row + all : row)};
}

std::vector<std::size_t> pickedRows(std::size_t count, const py::slice& which) {
  std::size_t start = 0, stop = 0, step = 0, picked = 0;
  if (!which.compute(count, &start, &stop, &step, &picked)) throw py::error_already_set();
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < picked; ++k, start += step) out.push_back(start);
  return out;
}

py::array view(const py::object& self, const double* first, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides) {
  py::array out(py::dtype::of<double>(), std::move(shape), std::move(strides), first, self);
  py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return out;
}

py::array numbersIn(const py::object& values, const std::string& what) {
  if (isMasked(values)) throw py::value_error(what + " (found a masked array)");
  const py::array out(values);
  if (std::string("iuf").find(out.dtype().kind()) == std::string::npos)
    throw py::value_error(what + " (found " +
                          (out.dtype().kind() == 'U'   ? "text"
                           : out.dtype().kind() == 'O' ? "objects"
                                                       : std::string(py::str(out.dtype().attr("name")))) +
                          ")");
  return out;
}

py::array_t<double> rowsOf(const py::object& values, py::ssize_t width, const char* what) {
  Array given = numbers(values, what);
  if (given.ndim() == 1 && given.shape(0) == width) given = given.reshape({py::ssize_t{1}, width});
  if (given.ndim() != 2 || given.shape(1) != width)
    throw py::value_error(std::string(what) + ": shape " + shapeOf(given) + ", expected (N, " + std::to_string(width) +
                          ")");
  return given;
}

py::array_t<double> columnOf(const py::object& values, const char* what) {
  Array given = numbers(values, what);
  if (given.ndim() == 0) given = given.reshape({py::ssize_t{1}});
  if (given.ndim() != 1)
    throw py::value_error(std::string(what) + ": shape " + shapeOf(given) + ", expected (N,) or a number");
  return given;
}

void refuseOutside(const py::array_t<double>& instants, double duration) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const double *first = instants.data(), *last = first + instants.size(), slack = rounding * duration;
  const double* found = std::find_if(first, last, [&](double t) { return t < -slack || t > duration + slack; });
  if (found == last) return;
  throw py::value_error("t[" + std::to_string(found - first) + "] = " + shown(*found) +
                        " s is outside of the motion, expected 0 to " + shown(duration) + " s");
}

void addMotion(py::module_& module) {
  using M = Motion<double>;
  constexpr py::ssize_t size = sizeof(double);
  py::class_<Motions> motion(module, "Motion", words::motion);
  addCopies(motion);
  motion.def(pickled<Motions>())
      .def(py::init(&motionsFrom), py::arg("t"), py::arg("p"), py::arg("q"), py::arg("v") = py::none(),
           py::arg("w") = py::none(), py::arg("a") = py::none(), py::arg("alpha") = py::none())
      .def_property_readonly("t", member(&M::t, {}, {}), "Instants, s: (N,).")
      .def_property_readonly("p", member(&M::p, {3}, {size}), "Position of P in B, m: (N, 3).")
      .def_property_readonly("Q", member(&M::Q, {3, 3}, {size, 3 * size}), "Orientation of M in B: (N, 3, 3).")
      .def_property_readonly(
          "q",
          [](const Motions& motion) {
            return table(quaternions(motion.rows), 4,
                         [](const Eigen::Vector4d& q, double* to) { Eigen::Map<Eigen::Vector4d>{to} = q; });
          },
          words::q)
      .def_property_readonly("v", member(&M::p_dot, {3}, {size}), "Velocity of P in B, m/s: (N, 3).")
      .def_property_readonly("w", member(&M::omega, {3}, {size}), "Angular velocity in B, rad/s: (N, 3).")
      .def_property_readonly("a", member(&M::p_ddot, {3}, {size}), "Acceleration of P in B, m/s²: (N, 3).")
      .def_property_readonly("alpha", member(&M::omega_dot, {3}, {size}), "Angular acceleration in B, rad/s²: (N, 3).")
      .def("__len__", [](const Motions& motion) { return motion.rows.size(); })
      .def("__getitem__", &chosen<py::ssize_t>, py::arg("row"))
      .def("__getitem__", &chosen<py::slice>, py::arg("rows"))
      .def("__repr__", [](const Motions& motion) {
        const std::size_t count = motion.rows.size();
        return "<ursula.Motion of " + std::to_string(count) + (count == 1 ? " instant>" : " instants>");
      });
}

}  // namespace ursula::python
