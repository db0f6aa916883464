#pragma once

#include "model/scenario.h"
#include "nocsolver/noc/noc.h"

namespace ursula {

/// The reference for every engine: the paper's method as a validation judges it.
class EngineReference {
 public:
  struct Here {
    Motion<double> motion;
    Vector6d efforts, q_dot;  ///< motors' efforts and rates, in their order
  };

  explicit EngineReference(const Scenario& scenario);

  Here at(double t);
  /// Returns the machine's characteristic length, m.
  double length() const { return noc_.machine().length; }

 private:
  const Scenario& scenario_;
  Noc<double> noc_;
  NocWorkspace<double> work_;
};

}  // namespace ursula
