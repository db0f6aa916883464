#include "parts/causes/asked_apart.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include "validation/limits/conditioning.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

constexpr std::size_t most_poses = 6;
/// A part below this share of all efforts counts as zero.
constexpr double nothing = 1e-9;

/// The questions at one pose. Both signs of each velocity separate even terms from odd ones.
enum Question { rest, accelerated, turned_faster, moving, moving_back, turning, turning_back, both, both_back, again };
constexpr std::size_t questions = again + 1;
using Answers = std::array<Vector6d, questions>;

constexpr const char* part_names[] = {
    "statics", "acceleration", "angular_acceleration", "velocity", "angular_velocity", "mixed", "odd", repeat_term};
constexpr std::size_t parts_count = std::size(part_names), repeat = parts_count - 1;
using Parts = std::array<Vector6d, parts_count>;

/// A vector with another direction at each pose.
Vector3d someVector(double size, std::size_t k) {
  const auto x = static_cast<double>(k);
  return size * Vector3d(std::cos(1 + 2 * x), std::sin(2 + 3 * x), std::cos(3 - x));
}

/// The motion's own velocities may be zero, so they are not used. The same numbers serve as accelerations.
Motion<double> asked(const Motion<double>& at, Question question, const Vector3d& v, const Vector3d& w) {
  Motion<double> out = at;
  out.p_dot = out.omega = out.p_ddot = out.omega_dot = Vector3d::Zero();
  if (question == accelerated) out.p_ddot = v;
  if (question == turned_faster) out.omega_dot = w;
  if (question == moving || question == both) out.p_dot = v;
  if (question == moving_back || question == both_back) out.p_dot = -v;
  if (question == turning || question == both) out.omega = w;
  if (question == turning_back || question == both_back) out.omega = -w;
  return out;
}

Parts partsOf(const Answers& is) {
  Parts out;
  out[0] = is[rest];
  out[1] = is[accelerated] - is[rest];
  out[2] = is[turned_faster] - is[rest];
  out[3] = (is[moving] + is[moving_back]) / 2 - is[rest];
  out[4] = (is[turning] + is[turning_back]) / 2 - is[rest];
  out[5] = (is[both] + is[both_back]) / 2 - is[rest] - out[3] - out[4];
  out[6] = (is[both] - is[both_back]) / 2;
  out[repeat] = is[again] - is[rest];
  return out;
}

/// Poses along the motion, with velocities for the questions.
struct Poses {
  std::vector<Motion<double>> at;
  std::vector<Vector3d> v, w;
};

Poses posesOf(const Manipulator& machine, const std::vector<Motion<double>>& motions) {
  const double length = machine.leg(0).platform_point.norm();
  const double rate = std::sqrt(std::max(machine.gravity().norm(), 1e-3) / std::max(length, 1e-3));
  Poses out;
  const std::size_t count = std::min(most_poses, motions.size());
  for (std::size_t k = 0; k < count; ++k) {
    out.at.push_back(motions[k * (motions.size() - 1) / std::max<std::size_t>(1, count - 1)]);
    out.v.push_back(someVector(rate * length, k));
    out.w.push_back(someVector(rate, k + 7));
  }
  return out;
}

/// Second differences of the answers to questions a few units of single precision apart; in double precision they are
/// rounding.
Vector6d grainOf(const Subject& subject, const Poses& poses) {
  constexpr int steps = 8;
  constexpr double step = 2e-8;  // relative; a float's unit is 6e-8
  Vector6d grain = Vector6d::Zero();
  for (std::size_t k = 0; k < poses.at.size(); ++k) {
    std::array<Vector6d, steps> answers;
    for (int j = 0; j < steps; ++j) {
      Motion<double> near = asked(poses.at[k], both, poses.v[k], poses.w[k]);
      near.p += j * step * someVector(near.p.norm(), k);
      near.Q = (Eigen::AngleAxisd(j * step, someVector(1, k).normalized()) * near.Q).eval();
      near.omega *= 1 + j * step;
      answers[j] = subject.torques(near);
    }
    for (std::size_t j = 2; j < steps; ++j)
      grain = grain.cwiseMax((answers[j] - 2 * answers[j - 1] + answers[j - 2]).cwiseAbs());
  }
  return grain;
}

/// Asks every question at every pose; then repeats the first one, from the last pose to the first.
std::vector<Answers> answersOf(const Subject& subject, const Poses& poses) {
  std::vector<Answers> out(poses.at.size());
  const auto ask = [&](std::size_t k, Question question) {
    out[k][question] = subject.torques(asked(poses.at[k], question, poses.v[k], poses.w[k]));
  };
  for (std::size_t k = 0; k < out.size(); ++k)
    for (int question = rest; question < again; ++question) ask(k, static_cast<Question>(question));
  for (std::size_t k = out.size(); k-- > 0;) ask(k, again);
  return out;
}

std::vector<TermError> termErrors(const std::vector<Answers>& found, const std::vector<Answers>& expected) {
  std::array<double, parts_count> error{}, size{};
  double all = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Parts of = partsOf(found[k]), right = partsOf(expected[k]);
    for (std::size_t part = 0; part < parts_count; ++part) {
      error[part] = larger(error[part], (of[part] - right[part]).norm());
      size[part] = std::max(size[part], right[part].norm());
      if (part != repeat) all = std::max(all, right[part].norm());
    }
  }
  std::vector<TermError> out;
  for (std::size_t part = 0; part < parts_count; ++part)
    out.push_back({part_names[part], error[part] / (size[part] > nothing * all ? size[part] : all)});
  return out;
}

/// Whether answers depend on the question; a solver that looks up instants always answers the same.
bool listens(const std::vector<Answers>& answers) {
  return std::any_of(answers.begin(), answers.end(), [](const Answers& is) {
    return std::any_of(is.begin(), is.end(), [&](const Vector6d& one) { return one != is.front(); });
  });
}

}  // namespace

AskedApart askedApart(const Subject& subject, const Scenario& scenario, const std::vector<Motion<double>>& motions) {
  const Poses poses = posesOf(*scenario.manipulator, motions);
  std::vector<Answers> found, expected;
  AskedApart out;
  try {
    found = answersOf(subject, poses);
    out.grain = grainOf(subject, poses);
    for (std::size_t k = poses.at.size(); k-- > 0;) {
      out.again_t.push_back(poses.at[k].t);
      out.again.push_back(subject.torques(poses.at[k]));
    }
    expected = answersOf(nocSubject(*scenario.manipulator, scenario.load), poses);
  } catch (const std::exception&) {  // no answer to questions outside the motion
    return {};
  }
  if (poses.at.empty()) return out;
  out.terms = termErrors(found, expected);
  if (!listens(found)) return out;
  ConditioningProbe probe(*scenario.manipulator, scenario.load);
  for (std::size_t k = 0; k < found.size(); ++k)
    for (int question = rest; question < again; ++question) {
      if (!found[k][question].allFinite()) return {{}, {}, {}, {}, out.terms};
      out.motions.push_back(asked(poses.at[k], static_cast<Question>(question), poses.v[k], poses.w[k]));
      out.found.push_back(found[k][question]);
      out.expected.push_back(expected[k][question]);
      out.rounding.push_back(probe.at(out.motions.back()).torqueRounding());
    }
  return out;
}

}  // namespace ursula
