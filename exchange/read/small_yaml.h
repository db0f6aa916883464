#pragma once

#include <map>
#include <string>
#include <vector>

namespace ursula::exchange {

/// The few shapes of YAML that a robot.yaml has: `key: word`, `key: [a, [b, c]]`, and lists of `- a` below a key.
struct SmallYaml {
  std::map<std::string, std::vector<std::string>> values;  ///< nested lists as one

  std::vector<std::string> list(const std::string& key) const;
  std::string word(const std::string& key) const;
};

/// Throws ImportError at what is of another shape.
SmallYaml readSmallYaml(const std::string& text, const std::string& name);

}  // namespace ursula::exchange
