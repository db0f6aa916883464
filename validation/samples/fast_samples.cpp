#include "validation/samples/fast_samples.h"

#include "nocsolver/fast/batch_dynamics.h"
#include "nocsolver/fast/fast_dynamics.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

constexpr std::size_t most_instants = 500;

/// What is asked of everybody.
struct Questions {
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> loads, efforts;
};

FastAnswers answersOf(const kernel::MachineModel<double>& model, InstructionSet set, const Questions& asked) {
  const FastDynamics<double> one(model, set);
  const BatchDynamics batch(model, set);
  const std::size_t count = asked.motions.size();
  FastAnswers out;
  out.set = set;
  for (std::size_t k = 0; k < count; ++k) {
    out.torques.push_back(one.inverseDynamics(asked.motions[k], asked.loads[k]));
    out.accelerations.push_back(one.directDynamics(asked.motions[k], asked.efforts[k], asked.loads[k]));
  }
  out.torques_in_batch.resize(count);
  out.accelerations_in_batch.resize(count);
  std::vector<PoseFault> faults(count);  // a pose without an answer is NaN, which no check accepts
  batch.inverseDynamics(asked.motions.data(), count, out.torques_in_batch.data(), faults.data(), asked.loads.data());
  batch.directDynamics(asked.motions.data(), asked.efforts.data(), count, out.accelerations_in_batch.data(),
                       faults.data(), asked.loads.data());
  return out;
}

}  // namespace

FastSamples runFast(const Scenario& scenario, const std::vector<PointwiseSample>& samples, const FastFault& fault) {
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  auto model = kernel::machineModel(MachineParameters<double>(*scenario.manipulator));
  if (fault.model) fault.model(model);
  FastSamples out;
  Questions asked;
  try {
    const std::size_t stride = 1 + samples.size() / most_instants;
    for (std::size_t k = 0; k < samples.size(); k += stride) {
      const PointwiseSample& sample = samples[k];
      out.samples.push_back(k);
      asked.motions.push_back(sample.motion);
      asked.loads.push_back(loadAtP(scenario.load.get(), sample.motion));
      out.torques.push_back(noc.torques(sample.motion));
      out.efforts.push_back(otherTorques(out.torques.back()));
      out.accelerations.push_back(noc.accelerations(sample.motion, out.efforts.back()));
    }
    asked.efforts = out.efforts;
    for (const InstructionSet set :
         {InstructionSet::portable, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
      if (!isSupported(set)) continue;
      out.answers.push_back(answersOf(model, set, asked));
      if (fault.answers) fault.answers(out.answers.back());
    }
  } catch (const PoseError& refusal) {
    out.refused = refusal.what();
  }
  return out;
}

}  // namespace ursula
