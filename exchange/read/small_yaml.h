#pragma once

#include <map>
#include <string>
#include <vector>

namespace ursula::exchange {

/// The few forms of YAML in a robot.yaml: `key: word`, `key: [a, [b, c]]`, and lists of `- a` below a key.
struct SmallYaml {
  std::map<std::string, std::vector<std::string>> values;  ///< nested lists are flattened

  std::vector<std::string> list(const std::string& key) const;
};

/// Throws ImportError for any other form.
SmallYaml readSmallYaml(const std::string& text, const std::string& name);

}  // namespace ursula::exchange
