#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace ursula {

/// A key that leads to no number of a scenario; says what is wrong with it.
struct NumberKeyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Numbers of a scenario's document by dotted keys. `manipulator.leg.3.distal.mass`: tables of an array count from 1,
/// entries of an array of numbers from 0. What is not found at the top is looked for in `manipulator`. A number that
/// the document leaves to the leg's defaults, or to the program's, is written out where it is first asked for.
///
/// Internal: a document of toml++ is in its interface. Refers to the document.
class ScenarioNumbers {
 public:
  explicit ScenarioNumbers(toml::table& document) : document_(document) {}

  /// The keys that one with `*` stands for; else it alone. With `manipulator.` where it was left out.
  std::vector<std::string> expanded(const std::string& key) const;

  /// From now on the number of this key can be set; its number as it stands is returned.
  double hold(const std::string& key);
  /// Whether the k-th that is held takes integers alone.
  bool isInteger(std::size_t k) const { return held_[k].node->is_integer(); }
  /// Sets the k-th that is held. Throws NumberKeyError for what is no integer where one is needed.
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
