#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace ursula {

/// A key that matches no number of a scenario, with the reason.
struct NumberKeyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Accesses numbers of a scenario's document by dotted keys. In `manipulator.leg.3.distal.mass`, tables of an array
/// count from 1, entries of an array of numbers from 0. Keys not found at the top are searched in `manipulator`. A
/// number that comes from the leg's defaults or the program's is written into the document on first access.
///
/// Internal, because its interface has a document of toml++. Refers to the document.
class ScenarioNumbers {
 public:
  explicit ScenarioNumbers(toml::table& document) : document_(document) {}

  /// Expands `*` to all matching keys; other keys stay. Adds a missing `manipulator.`.
  std::vector<std::string> expanded(const std::string& key) const;

  /// Lists the key's number among those that set() changes, and returns its current value.
  double hold(const std::string& key);
  /// Returns the place of the number that was held last. It stays valid while others are held.
  const toml::node* last() const { return held_.back().node; }
  /// Returns whether the k-th held number must be an integer.
  bool isInteger(std::size_t k) const { return held_[k].node->is_integer(); }
  /// Sets the k-th held number. Throws NumberKeyError for a non-integer if an integer is required.
  void set(std::size_t k, double value);

 private:
  struct Held {
    std::string key;
    toml::node* node;
  };
  toml::table& document_;
  std::vector<Held> held_;
};

}  // namespace ursula
