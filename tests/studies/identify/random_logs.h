#pragma once

#include <map>
#include <string>

#include "studies/identify/identify.h"
#include "tests/studies/identify/synthetic_log.h"

namespace ursula {

/// The error in the model that judges a log of a random machine.
enum class RandomWrong { nothing, one_number };

/// A machine of any kind with its log, and its model, which deviates within its tolerances.
struct RandomLog {
  Scenario model;
  NumberTolerances tolerances;
  ManipulatorParameters truth;
  std::string wrong;  ///< path of the number that is off by five tolerances
  SyntheticLog how;
  SyntheticRows rows;
};
RandomLog randomLog(unsigned seed, RandomWrong wrong);

/// Statistics over a number of logs.
struct LogStatistics {
  struct Share {
    int hits = 0, of = 0;
    double share() const { return of > 0 ? static_cast<double>(hits) / of : 0; }
  };
  std::map<std::string, Share> within;  ///< combinations whose true value is in the interval, by group
  Share delay_within, delay_near;       ///< true delay in its interval; delay right to a tenth of a sample
  Share right_passed, wrong_named, wrong_failed;

  void add(const RandomLog& log, const IdentifyResult& result);
  std::string text() const;
};

}  // namespace ursula
