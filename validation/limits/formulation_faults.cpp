#include "validation/limits/formulation_faults.h"

#include <algorithm>
#include <utility>

namespace ursula {
namespace {

class FaultyEngine final : public Engine {
 public:
  FaultyEngine(std::unique_ptr<Engine> engine, EngineFault fault)
      : engine_(std::move(engine)), fault_(std::move(fault)) {}
  Vector6d inverseDynamics(const Motion<double>& motion) override {
    return fault_.applied(engine_->inverseDynamics(motion));
  }

 private:
  std::unique_ptr<Engine> engine_;
  EngineFault fault_;
};

}  // namespace

Manipulator EngineFault::applied(const Manipulator& right) const {
  ManipulatorParameters out = right.parameters();
  if (machine) machine(out);
  return Manipulator(out);
}

Scenario EngineFault::applied(Scenario right) const {
  if (machine) right.manipulator = std::make_shared<const Manipulator>(applied(*right.manipulator));
  return right;
}

Vector6d EngineFault::applied(Vector6d right) const {
  if (efforts) efforts(right);
  return right;
}

FormulationFaults::operator bool() const {
  return simbody || solver ||
         std::any_of(further.begin(), further.end(), [](const EngineFault& each) { return static_cast<bool>(each); });
}

OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load,
                                                             const OfFurtherEngines<EngineFault>& faults) {
  OfFurtherEngines<std::unique_ptr<Engine>> out = makeFurtherEngines(manipulator, load);
  for (std::size_t k = 0; k < furtherEngines().size(); ++k)
    if (faults[k] && out[k])
      out[k] =
          std::make_unique<FaultyEngine>(furtherEngines()[k].make(faults[k].applied(manipulator), load), faults[k]);
  return out;
}

}  // namespace ursula
