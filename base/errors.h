#pragma once

#include <stdexcept>
#include <string>

namespace ursula {

/// A parameter that no machine or motion can have. `place` is the dotted key of the scenario
/// (`manipulator.leg[2].proximal.mass`, legs 1-based); `bound` says what was expected.
class InvalidParameter : public std::invalid_argument {
 public:
  InvalidParameter(std::string place, std::string value, std::string bound)
      : std::invalid_argument(place + ": " + value + ", expected " + bound),
        place_(std::move(place)),
        value_(std::move(value)),
        bound_(std::move(bound)) {}

  const std::string& place() const { return place_; }
  const std::string& value() const { return value_; }
  const std::string& bound() const { return bound_; }

 private:
  std::string place_, value_, bound_;
};

/// A file or an argument that cannot be used. The text begins with its place, and the program prints it as it is.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The message for std::bad_alloc. It says nothing about the input and is never a finding.
inline constexpr const char* out_of_memory = "out of memory";
/// The same when scenarios are validated.
inline constexpr const char* out_of_memory_for_scenario =
    "out of memory: fewer samples in the scenario's [simulation], or fewer --jobs, need less";

}  // namespace ursula
