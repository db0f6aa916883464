#pragma once

#include <memory>
#include <mutex>

namespace ursula {

/// A value that the first requesting thread computes while others wait. If the computation throws, the next one tries.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(once_, [&] { value_.reset(new T(make())); });  // in place, so T need not be movable
    return *value_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const T> value_;
};

}  // namespace ursula
