#pragma once

#include <map>
#include <string>

#include "parts/identify/identify.h"
#include "tests/studies/identify/synthetic_log.h"

namespace ursula {

/// A machine of any kind with its log, and its model, which deviates within its tolerances.
struct RandomLog {
  Scenario model;
  NumberTolerances tolerances;
  ManipulatorParameters truth;
  std::string wrong;  ///< path of the number that is off by five tolerances
  SyntheticLog how;
  SyntheticRows rows;
};
/// Makes the log; one number among these paths is off by five tolerances, unless there are none.
RandomLog randomLog(unsigned seed, const std::vector<std::string>& wrong_among = {});
/// Returns the paths of masses and mass centres of a random log's model.
std::vector<std::string> massesAndCenters(const RandomLog& log);

/// Statistics over a number of logs.
struct LogStatistics {
  struct Share {
    int hits = 0, of = 0;
    double share() const { return of > 0 ? static_cast<double>(hits) / of : 0; }
  };
  std::map<std::string, Share> within;  ///< combinations whose true value is in the interval, by group
  Share delay_within, delay_near;       ///< true delay in its interval; delay right to a tenth of a sample
  Share delay_near_known;               ///< the same if its own uncertainty is at most half of that
  Share right_passed, wrong_named, wrong_failed;

  void add(const RandomLog& log, const IdentifyResult& result);
  std::string text() const;
};

}  // namespace ursula
