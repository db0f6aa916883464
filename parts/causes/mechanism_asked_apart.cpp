#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include "parts/causes/mechanism_tried.h"
#include "validation/verdict/worst_share.h"

namespace ursula::mechanisms {
namespace {

constexpr std::size_t most_poses = 6;
/// A part below this share of all efforts counts as zero.
constexpr double no_part = 1e-9;

/// The questions at one pose; the first one is repeated in the end. Both signs of the rates separate even terms from
/// odd ones.
enum Apart { at_rest, accelerating, forward, backward, repeated };
constexpr std::size_t apart_count = repeated + 1;
using PartAnswers = std::array<MotorEfforts, apart_count>;

constexpr const char* part_words[] = {"statics", "acceleration", "velocity", "odd", repeat_term};

PartAnswers partsFrom(const PartAnswers& is) {
  return {is[at_rest], is[accelerating] - is[at_rest], (is[forward] + is[backward]) / 2 - is[at_rest],
          (is[forward] - is[backward]) / 2, is[repeated] - is[at_rest]};
}

/// The motors' own rates may be zero, so they are not used. The same numbers serve as accelerations.
MotorMotion askedOf(const Mechanism& mechanism, const MotorMotion& at, Apart question, std::size_t pose) {
  const double length = mechanism.length(), rate = std::sqrt(std::max(mechanism.gravity().norm(), 1e-3) / length);
  Eigen::VectorXd some(at.q.size());
  for (Eigen::Index k = 0; k < some.size(); ++k)
    some(k) = rate * std::cos(1 + 2.0 * static_cast<double>(pose) + 3.0 * static_cast<double>(k)) *
              (mechanism.motor(static_cast<std::size_t>(k)).slides() ? length : 1);
  MotorMotion out = at;
  out.qdot.setZero();
  out.qddot.setZero();
  if (question == accelerating) out.qddot = some;
  if (question == forward) out.qdot = some;
  if (question == backward) out.qdot = -some;
  return out;
}

std::vector<TermError> errorsOf(const std::vector<PartAnswers>& found, const std::vector<PartAnswers>& expected,
                                const MotorEfforts& in) {
  std::array<double, apart_count> error{}, size{};
  double all = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const PartAnswers of = partsFrom(found[k]), right = partsFrom(expected[k]);
    for (std::size_t part = 0; part < apart_count; ++part) {
      error[part] = larger(error[part], (of[part] - right[part]).cwiseProduct(in).norm());
      size[part] = std::max(size[part], right[part].cwiseProduct(in).norm());
      all = std::max(all, size[part]);
    }
  }
  std::vector<TermError> out;
  for (std::size_t part = 0; part < apart_count; ++part)
    if (all > 0) out.push_back({part_words[part], error[part] / (size[part] > no_part * all ? size[part] : all)});
  return out;
}

}  // namespace

std::vector<TermError> askedApart(const MechanismEvidence& evidence) {
  if (!evidence.ask) return {};
  const LoopMotion& motion = *evidence.motion;
  const std::size_t samples = evidence.samples.size(), poses = std::min(most_poses, samples);
  std::vector<PartAnswers> found(poses), expected(poses);
  std::vector<MechanismQuestion> questions;
  LoopWork work;
  for (std::size_t k = 0; k < poses; ++k)
    for (int question = at_rest; question <= repeated; ++question) {
      const MotorMotion& at = evidence.samples[k * (samples - 1) / std::max<std::size_t>(1, poses - 1)].motion;
      MechanismQuestion asked{askedOf(motion.solver().mechanism(), at, static_cast<Apart>(question), k), {}};
      loops::LoopPose pose = motion.near(at.t);
      motion.solver().moveTo(at.q, pose);
      expected[k][question] = motion.solver().inverseDynamics(asked.motion, pose, work);
      asked.joints = motion.solver().joints(work);
      questions.push_back(std::move(asked));
    }
  // Repetitions come last, from the last pose to the first.
  std::vector<MechanismQuestion> in_order;
  for (std::size_t i = 0; i < questions.size(); ++i)
    if (i % apart_count != repeated) in_order.push_back(questions[i]);
  for (std::size_t k = poses; k-- > 0;) in_order.push_back(questions[k * apart_count]);
  try {
    const std::vector<MotorEfforts> answers = evidence.ask(in_order);
    std::size_t next = 0;
    for (std::size_t k = 0; k < poses; ++k)
      for (int question = at_rest; question < repeated; ++question) found[k][question] = answers.at(next++);
    for (std::size_t k = poses; k-- > 0;) found[k][repeated] = answers.at(next++);
  } catch (const std::exception&) {  // no answer to questions outside the motion
    return {};
  }
  return errorsOf(found, expected, evidence.efforts_in);
}

}  // namespace ursula::mechanisms
