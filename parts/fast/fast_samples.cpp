#include "parts/fast/fast_samples.h"

#include "parts/fast/batch_dynamics.h"
#include "parts/fast/fast_dynamics.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

constexpr std::size_t most_instants = 500;
/// Size of a batch that repeats the same instants: many threads' shares and blocks of this program's own batches (512
/// poses), as users' are, and no multiple of a kernel's lanes.
constexpr std::size_t in_batch = 32771;

/// The questions to all kernels, in SI as users ask them; loads only if there is one.
struct Questions {
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> loads, efforts;
};

template <class T>
std::vector<T> repeated(const std::vector<T>& of) {
  std::vector<T> out;
  if (of.empty()) return out;
  out.reserve(in_batch);
  for (std::size_t k = 0; k < in_batch; ++k) out.push_back(of[k % of.size()]);
  return out;
}

FastAnswers answersOf(const kernel::MachineModel<double>& model, InstructionSet set, const Questions& asked) {
  const FastDynamics<double> one(model, set);
  const BatchDynamics batch(model, set);
  FastAnswers out;
  out.set = set;
  for (std::size_t k = 0; k < asked.motions.size(); ++k) {
    const Vector6d load = asked.loads.empty() ? Vector6d(Vector6d::Zero()) : asked.loads[k];
    out.torques.push_back(one.inverseDynamics(asked.motions[k], load));
    out.accelerations.push_back(one.directDynamics(asked.motions[k], asked.efforts[k], load));
  }
  const Questions many{repeated(asked.motions), repeated(asked.loads), repeated(asked.efforts)};
  const Vector6d* loads = many.loads.empty() ? nullptr : many.loads.data();
  out.torques_in_batch.resize(many.motions.size());
  out.accelerations_in_batch.resize(many.motions.size());
  std::vector<PoseFault> faults(many.motions.size());  // a pose without an answer gives NaN, which fails every check
  batch.inverseDynamics(many.motions.data(), many.motions.size(), out.torques_in_batch.data(), faults.data(), loads);
  batch.directDynamics(many.motions.data(), many.efforts.data(), many.motions.size(), out.accelerations_in_batch.data(),
                       faults.data(), loads);
  return out;
}

/// Converts from the units of `natural` to SI.
FrameChange inSi(const Manipulator& machine, const Units& natural) {
  FrameChange out(machine);
  out.units.length = 1 / natural.length;
  out.units.mass = 1 / natural.mass;
  out.units.time = 1 / natural.time;
  return out;
}

void bringBack(const FrameChange& si, FastAnswers& answers) {
  for (auto* torques : {&answers.torques, &answers.torques_in_batch})
    for (Vector6d& each : *torques) each = si.torquesBack(each);
  for (auto* accelerations : {&answers.accelerations, &answers.accelerations_in_batch})
    for (Vector6d& each : *accelerations) {
      each.head<3>() *= 1 / (si.units.time * si.units.time);
      each.tail<3>() *= si.units.acceleration();
    }
}

}  // namespace

FastSamples runFast(const Scenario& scenario, const Units& natural, const std::vector<PointwiseSample>& samples,
                    const FastFault& fault) {
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  const FrameChange si = inSi(*scenario.manipulator, natural);
  auto model = kernel::machineModel(MachineParameters<double>(si.transformed(*scenario.manipulator)));
  if (fault.model) fault.model(model);
  const std::shared_ptr<const Load> load = si.transformed(scenario.load);
  FastSamples out;
  Questions asked;
  try {
    const std::size_t stride = 1 + samples.size() / most_instants;
    for (std::size_t k = 0; k < samples.size(); k += stride) {
      const Motion<double>& motion = samples[k].motion;
      out.samples.push_back(k);
      out.torques.push_back(noc.torques(motion));
      out.efforts.push_back(otherTorques(out.torques.back()));
      out.accelerations.push_back(noc.accelerations(motion, out.efforts.back()));
      asked.motions.push_back(si.transformed(motion));
      asked.efforts.push_back(si.transformed(out.efforts.back()));
      if (load) asked.loads.push_back(loadAtP(load.get(), asked.motions.back()));
    }
    for (const InstructionSet set :
         {InstructionSet::portable, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
      if (!isSupported(set)) continue;
      out.answers.push_back(answersOf(model, set, asked));
      bringBack(si, out.answers.back());
      if (fault.answers) fault.answers(out.answers.back());
    }
  } catch (const PoseError& refusal) {
    out.refused = refusal.what();
  }
  return out;
}

}  // namespace ursula
