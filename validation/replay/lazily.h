#pragma once

#include <memory>
#include <mutex>

namespace ursula {

/// Made when first asked for, by whichever thread asks first; the others wait. Where making throws, the next one tries.
template <class T>
class Lazily {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(once_, [&] { value_.reset(new T(make())); });  // in place: T need not move
    return *value_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const T> value_;
};

}  // namespace ursula
