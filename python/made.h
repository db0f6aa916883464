#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <type_traits>

namespace ursula {

struct ChannelComparison;
struct Check;
struct Comparison;
struct EffortDeviation;
struct Finding;
struct MechanismBody;
struct NamedCause;
struct PlatformPose;
struct ReplayError;
struct ValidationResult;

}  // namespace ursula

namespace ursula::python {

struct MechanismMotion;
struct MechanismWithSolver;
struct Motions;
struct ScenarioWithSolver;
struct Simulated;

template <class T, class... Types>
constexpr bool is_one_of = (std::is_same_v<T, Types> || ...);

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

template <class T>
constexpr bool is_made = is_one_of<T, ChannelComparison, Check, Comparison, EffortDeviation, Finding, MechanismBody,
                                   MechanismMotion, MechanismWithSolver, Motions, NamedCause, PlatformPose, ReplayError,
                                   ScenarioWithSolver, Simulated, ValidationResult>;

}  // namespace ursula::python

/// Every class of this module is cast so.
template <class T>
class pybind11::detail::type_caster<T, std::enable_if_t<ursula::python::is_made<T>>>
    : public ursula::python::MadeCaster<T> {};
