#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace ursula::python {

/// Refuses an uninitialised object from cls.__new__(cls), for which pybind11 would return uninitialised memory.
template <class T>
class MadeCaster : public pybind11::detail::type_caster_base<T> {
  using Base = pybind11::detail::type_caster_base<T>;

 public:
  bool load(pybind11::handle from, bool convert) {
    const pybind11::detail::type_info* type = Base::typeinfo;
    if (pybind11::isinstance(from, reinterpret_cast<PyObject*>(type->type)) &&
        !reinterpret_cast<pybind11::detail::instance*>(from.ptr())->get_value_and_holder(type))
      throw pybind11::type_error(std::string(type->type->tp_name) + ": __init__() was never called");
    return Base::load(from, convert);
  }
};

}  // namespace ursula::python
