#include "model/check_catalogue.h"

#include <algorithm>

namespace ursula {

const std::vector<CheckRow>& checkCatalogue() {
  static const std::vector<CheckRow> catalogue = [] {
    std::vector<CheckRow> rows;
    for (const auto& part : {checksOfInput(), checksOfTorques(), checksOfReplay()})
      rows.insert(rows.end(), part.begin(), part.end());
    return rows;
  }();
  return catalogue;
}

std::vector<std::string> namesOfChecks() {
  std::vector<std::string> out;
  for (const CheckRow& check : checkCatalogue()) out.emplace_back(check.name);
  return out;
}

const CheckRow* checkRow(const std::string& name) {
  const std::vector<CheckRow>& rows = checkCatalogue();
  const auto found = std::find_if(rows.begin(), rows.end(), [&name](const CheckRow& row) { return name == row.name; });
  return found == rows.end() ? nullptr : &*found;
}

std::string checkTitle(const std::string& name) {
  const CheckRow* row = checkRow(name);
  return row == nullptr ? name : row->title;
}

const std::vector<std::string>& checkGroups() {
  static const std::vector<std::string> groups = {
      "Motors: the formulations agree on the efforts", "Fast kernels: what users call is the NOC",
      "Motion: the efforts make it in Simbody",        "Kinematics: solver and Simbody agree",
      "Numerics: the integration can be trusted",      "Input: the motion asked for is well defined",
  };
  return groups;
}

std::size_t groupOf(const std::string& check) {
  const CheckRow* row = checkRow(check);
  return row == nullptr ? checkGroups().size() : static_cast<std::size_t>(row->group);
}

const char* name(LimitFrom from) {
  static constexpr const char* names[] = {"exact", "derived", "measured"};
  return names[static_cast<std::size_t>(from)];
}

}  // namespace ursula
