#include "exchange/write/export.h"

#include "exchange/write/graph_of.h"

namespace ursula::exchange {

WrittenModel exportScenario(const Scenario& scenario, ModelFormat format) {
  const MachineModel machine = modelOf(scenario);
  WrittenModel out;
  out.notes = machine.graph.assumptions;
  switch (format) {
    case ModelFormat::sdf:
      out.text = sdfText(machine, out.notes);
      break;
    case ModelFormat::mjcf:
      out.text = mjcfText(machine, out.notes);
      break;
    case ModelFormat::urdf:
      out.text = urdfText(machine, out.notes);
      break;
  }
  return out;
}

}  // namespace ursula::exchange
