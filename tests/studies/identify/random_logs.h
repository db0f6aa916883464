#pragma once

#include <map>
#include <string>

#include "studies/identify/identify.h"
#include "tests/studies/identify/synthetic_log.h"

namespace ursula {

/// What is wrong with the model that a log of a random machine is judged by.
enum class RandomWrong { nothing, one_number };

/// A machine of any kind with its log, and the model of it, which is off by what tolerances let it be.
struct RandomLog {
  Scenario model;
  NumberTolerances tolerances;
  ManipulatorParameters truth;
  std::string wrong;  ///< path of the number that is off by five tolerances
  SyntheticLog how;
  SyntheticRows rows;
};
RandomLog randomLog(unsigned seed, RandomWrong wrong);

/// What a number of logs has shown.
struct LogStatistics {
  struct Share {
    int hits = 0, of = 0;
    double share() const { return of > 0 ? static_cast<double>(hits) / of : 0; }
  };
  std::map<std::string, Share> within;  ///< combinations whose true value is in the interval, by group
  Share delay_within, delay_near;       ///< in its interval; within a tenth of a sample
  Share right_passed, wrong_named, wrong_failed;

  void add(const RandomLog& log, const IdentifyResult& result);
  std::string text() const;
};

}  // namespace ursula
