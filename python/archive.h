#pragma once

#include <pybind11/pybind11.h>
#include <ursula/build.h>
#include <ursula/scenario.h>
#include <ursula/validate.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

namespace ursula::python {

/// Converts values to bytes for this version of the program on this kind of machine, and back; one traversal serves
/// both.
class Archive {
 public:
  Archive() = default;  ///< for writing
  explicit Archive(std::string from) : bytes_(std::move(from)), reads_(true) {}

  const std::string& bytes() const { return bytes_; }
  bool reads() const { return reads_; }

  template <class... T>
  void operator()(T&... values) {
    (walk(values), ...);
  }

 private:
  void raw(void* data, std::size_t size) {
    if (!reads_) {
      bytes_.append(static_cast<const char*>(data), size);
      return;
    }
    if (size > bytes_.size() - taken_) throw std::invalid_argument("a pickle that ends early");
    std::memcpy(data, bytes_.data() + taken_, size);
    taken_ += size;
  }

  template <class T>
  void walk(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>)
      raw(&value, sizeof value);
    else
      members(*this, value);
  }
  template <int rows, int columns>
  void walk(Eigen::Matrix<double, rows, columns>& value) {
    raw(value.data(), sizeof(double) * value.size());
  }
  template <class Sequence>
  void walkAll(Sequence& values) {
    std::size_t size = values.size();
    walk(size);
    if (reads_ && size > bytes_.size() - taken_) throw std::invalid_argument("a pickle that ends early");
    values.resize(size);
    for (auto& each : values) walk(each);
  }
  void walk(std::string& text) { walkAll(text); }
  template <class T>
  void walk(std::vector<T>& values) {
    walkAll(values);
  }
  template <class A, class B>
  void walk(std::pair<A, B>& both) {
    (*this)(both.first, both.second);
  }
  template <class T>
  void walk(std::optional<T>& value) {
    bool has = value.has_value();
    walk(has);
    if (reads_ && has) value.emplace();
    if (has) walk(*value);
  }

  std::string bytes_;
  std::size_t taken_ = 0;
  bool reads_ = false;
};

/// The hash of an archive of a T, which finds damage. A damaged archive could hold any number of rows or any
/// enumerator.
template <class T>
std::size_t hashOf(std::string_view bytes) {
  return std::hash<std::string_view>()(bytes) ^ typeid(T).hash_code();
}

/// pickle's two functions for a T that an Archive can traverse.
template <class T>
auto pickled() {
  namespace py = pybind11;
  return py::pickle(
      [](const T& value) {
        Archive archive;
        T copy = value;
        archive(copy);
        std::size_t hash = hashOf<T>(archive.bytes());
        archive(hash);
        return py::make_tuple(URSULA_VERSION, py::bytes(archive.bytes()));
      },
      [](const py::tuple& state) {
        const auto version = state[0].cast<std::string>();
        if (version != URSULA_VERSION)
          throw py::value_error("pickled by ursula " + version + ", expected " URSULA_VERSION);
        const auto bytes = state[1].cast<std::string>();
        const std::size_t size = bytes.size() - std::min(bytes.size(), sizeof(std::size_t));
        std::size_t hash = 0;
        Archive{bytes.substr(size)}(hash);
        if (hash != hashOf<T>(std::string_view(bytes).substr(0, size)))
          throw py::value_error("a pickle that ends early or is damaged");
        T value;
        Archive{bytes}(value);
        return value;
      });
}

/// Lets copies of an immutable object be the object itself.
template <class Class>
void addCopies(Class& of) {
  namespace py = pybind11;
  of.def("__copy__", [](const py::object& self) { return self; })
      .def(
          "__deepcopy__", [](const py::object& self, const py::dict&) { return self; }, py::arg("memo"));
}

}  // namespace ursula::python
