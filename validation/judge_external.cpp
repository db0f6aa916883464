#include "validation/judge_external.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/subject.h"
#include "validation/worst.h"

namespace ursula {
namespace {

/// Deviation of the leg that is furthest beyond, or nearest to, its own limit.
Deviation deviationOf(const Vector6d& torques, const Vector6d& exact, const Vector6d& precision, double rounding) {
  Deviation out;
  double worst = -1;
  for (int i = 0; i < leg_count; ++i) {
    const double error = std::abs(torques(i) - exact(i)), limit = rounding + precision(i);
    const double ratio = error / limit;
    if (ratio <= worst) continue;
    worst = ratio;
    out = {error, limit, i, precision(i)};
    if (std::isnan(ratio)) break;
  }
  return out;
}

/// What the torques may change by where the instant is off by its last digit.
Vector6d changeWithin(const std::function<Vector6d(double)>& noc, double t, double precision, double duration) {
  if (precision == 0) return Vector6d::Zero();
  const Vector6d here = noc(t);
  const Vector6d before = (noc(std::max(0.0, t - precision)) - here).cwiseAbs();
  const Vector6d after = (noc(std::min(duration, t + precision)) - here).cwiseAbs();
  return before.cwiseMax(after);
}

Check judgeAgainstNoc(const ExternalTorques& torques, const Units& units) {
  Worst shown;
  for (std::size_t k = 0; k < torques.against_noc.size(); ++k) {
    const Deviation& each = torques.against_noc[k];
    shown.add(each.error, each.limit, torques.file.t[k], each.where);
  }
  if (!shown.any) return notMade("torque.against_noc", "N m", "no instant was compared");
  Check check = judged("torque.against_noc", shown.value, shown.limit, "N m", "as for torque.pointwise",
                       fmt::format("torques against this program's NOC, at {} instants; shown for t = {:.6g} s, leg {}",
                                   torques.file.rows(), shown.t * units.time, shown.where + 1));
  check.largest = {shown.largest, shown.largest_t * units.time, placeName(shown.largest_where, false)};
  return check;
}

}  // namespace

double ExternalTorques::largestPrecision() const {
  double largest = 0;
  for (const Vector6d& row : precision) largest = std::max(largest, row.maxCoeff());
  return largest;
}

ExternalTorques runExternal(const Scenario& scenario, const TorqueFile& file) {
  const double duration = scenario.trajectory->duration();
  ExternalTorques out;
  out.file = within(file, duration);
  const Subject noc_subject = nocSubject(*scenario.manipulator, scenario.load);
  const auto noc = [&](double t) { return noc_subject.torques(scenario.trajectory->at(t)); };
  Subject subject;
  subject.name = file.file.filename().string();
  subject.torques = [&](const Motion<double>& motion) {  // asked for at the file's own instants alone
    const auto row = std::lower_bound(out.file.t.begin(), out.file.t.end(), motion.t) - out.file.t.begin();
    return out.file.torques.at(static_cast<std::size_t>(row));
  };
  out.samples = runPointwise(scenario, subject, out.file.t);
  for (std::size_t k = 0; k < out.file.rows(); ++k) {
    const double t = out.file.t[k];
    PointwiseSample& sample = out.samples[k];
    const Vector6d precision =
        out.file.torque_precision[k] + changeWithin(noc, t, out.file.time_precision[k], duration);
    const double rounding = sample.conditioning.torqueRounding();
    out.noc.push_back(noc(t));
    out.precision.push_back(precision);
    sample.torque = deviationOf(sample.torques, sample.torques_simbody, precision, rounding);
    sample.acceleration.given = sample.conditioning.response * precision.norm();
    sample.acceleration.limit += sample.acceleration.given;
    out.against_noc.push_back(deviationOf(sample.torques, out.noc.back(), precision, rounding));
  }
  return out;
}

std::vector<Check> judgeExternal(const ExternalTorques& torques, const Units& units) {
  std::vector<Check> checks = judgePointwise(torques.samples, false, units);
  checks.push_back(judgeAgainstNoc(torques, units));
  const double largest = torques.largestPrecision();
  const std::string precision =
      largest == 0 ? "; the file's digits are as fine as doubles and add nothing"
                   : fmt::format(
                         "; and half a unit of the last digit printed (torques of up to {} significant digits, "
                         "instants), up to {:.3g} N m",
                         torques.file.digits, largest * units.torque());
  for (Check& check : checks) check.basis += precision;
  return checks;
}

}  // namespace ursula
