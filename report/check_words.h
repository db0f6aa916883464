#pragma once

#include <string>
#include <vector>

namespace ursula::report {

/// Checks that answer one question together; a check belongs to the group of its name's part before the full stop.
struct CheckGroup {
  std::string title;
  std::vector<std::string> of;  ///< parts of names: "torque", "invariance", …
};

const std::vector<CheckGroup>& checkGroups();

/// Index into checkGroups(); its size for a name that belongs to none.
std::size_t groupOf(const std::string& check);

/// What a check is called, and what it shows, in words; name and "" for one that is not known.
struct CheckWords {
  std::string title, meaning;
};
CheckWords checkWords(const std::string& check);

}  // namespace ursula::report
