#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/csv.h"
#include "model/instants.h"
#include "tests/support/vectors.h"
#include "validation/subject/subject.h"
#include "validation/subject/torque_file.h"
#include "validation/validate.h"

namespace ursula {

inline const Scenario& helix() {
  static const Scenario scenario = vectorScenario("paper-helix");
  return scenario;
}

/// Instants with torques, to be falsified and written.
struct TorqueTable {
  std::vector<double> t;
  std::vector<Vector6d> torques;

  std::vector<std::string> names() const {
    std::vector<std::string> out = {"t_s"};
    for (int i = 1; i <= leg_count; ++i) out.push_back("tau_" + std::to_string(i) + "_Nm");
    return out;
  }

  /// The file's text, with 17 significant digits.
  std::string text() const {
    std::vector<std::vector<double>> columns = {t};
    for (int i = 0; i < leg_count; ++i) {
      columns.emplace_back();
      for (const Vector6d& row : torques) columns.back().push_back(row(i));
    }
    return csvText(names(), columns);
  }

  /// The file that a writer makes who prints each torque by `format`, such as "{:.3g}".
  TorqueFile printed(const std::string& format) const {
    std::string out = fmt::format("{}\n", fmt::join(names(), ","));
    for (std::size_t k = 0; k < t.size(); ++k) {
      out += fmt::format("{:.17g}", t[k]);
      for (const double tau : torques[k]) out += "," + fmt::format(fmt::runtime(format), tau);
      out += "\n";
    }
    return parseTorqueFile(out, "torques.csv");
  }

  TorqueFile file() const { return parseTorqueFile(text(), "torques.csv"); }

  /// The same with each row changed.
  TorqueTable changed(const std::function<void(std::size_t k, Vector6d&)>& change) const {
    TorqueTable out = *this;
    for (std::size_t k = 0; k < t.size(); ++k) change(k, out.torques[k]);
    return out;
  }
};

/// What `subject` answers at these instants.
inline TorqueTable torquesOf(const Scenario& scenario, const Subject& subject, const std::vector<double>& instants) {
  TorqueTable out{instants, {}};
  for (double t : instants) out.torques.push_back(subject.torques(scenario.trajectory->at(t)));
  return out;
}

/// Exact ones at `count` equally spaced instants.
inline TorqueTable exactTorques(const Scenario& scenario, int count) {
  return torquesOf(scenario, nocSubject(*scenario.manipulator, scenario.load),
                   equallySpaced(scenario.trajectory->duration(), count));
}

}  // namespace ursula
