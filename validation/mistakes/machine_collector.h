#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "validation/mistakes/cause.h"

namespace ursula {

class MachineSlopes;
struct TiedParameters;

/// Collects causes that are another machine. The scenario must outlive them.
class MachineCauses {
 public:
  using Change = std::function<void(ManipulatorParameters&, double)>;
  using Words = std::function<std::string(double, double)>;
  using Named = std::function<std::optional<NamedCause>(double, double)>;

  explicit MachineCauses(const Scenario& scenario);

  void addFitted(const Change& change, const Words& words, const Named& named);
  void addTied(const TiedParameters& tied);
  /// The effect of the change counts `times`: twice if a change that removes a term stands for its wrong sign.
  void addFixed(const CauseName& name, const std::function<void(ManipulatorParameters&)>& change, double times = 1);
  /// Adds a change of all links, of the proximal ones and of the distal ones, also of each kind of leg alone. `kind`
  /// and `term` name it.
  void addLinks(const std::string& before, const std::string& after, CauseKind kind, const char* term,
                const std::function<void(Link&)>& change);

  std::vector<Cause> causes;

 private:
  const Scenario& scenario_;
  std::shared_ptr<MachineSlopes> slopes_;
};

/// Points and axes of all legs at once: scaled, turned, numbered otherwise.
void addPointCauses(const Manipulator& machine, MachineCauses& out);

/// Friction that the scenario lacks, and parts of its own left out or with the wrong sign.
void addFrictionCauses(const Manipulator& machine, MachineCauses& out);

}  // namespace ursula
