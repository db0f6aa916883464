#include "validation/evidence/external_samples.h"

#include <algorithm>
#include <cmath>

#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// The deviation of the leg that exceeds its own limit most, or is nearest to it.
Deviation deviationOf(const Vector6d& torques, const Vector6d& exact, const Vector6d& precision, double rounding) {
  Deviation out;
  double worst = -1;
  for (int i = 0; i < motor_count; ++i) {
    const double error = std::abs(torques(i) - exact(i)), limit = rounding + precision(i);
    const double ratio = error / limit;
    if (ratio <= worst) continue;
    worst = ratio;
    out = {error, limit, i, precision(i)};
    if (std::isnan(ratio)) break;
  }
  return out;
}

/// The change of the torques if the instant is off by its last digit.
Vector6d changeWithin(const std::function<Vector6d(double)>& noc, double t, double precision, double duration) {
  if (precision == 0) return Vector6d::Zero();
  const Vector6d here = noc(t);
  const Vector6d before = (noc(std::max(0.0, t - precision)) - here).cwiseAbs();
  const Vector6d after = (noc(std::min(duration, t + precision)) - here).cwiseAbs();
  return before.cwiseMax(after);
}

}  // namespace

ExternalTorques runExternal(const Scenario& scenario, const TorqueFile& file, const Deadline& deadline) {
  const double duration = scenario.trajectory->duration();
  ExternalTorques out;
  out.file = within(file, duration);
  const Subject noc_subject = nocSubject(*scenario.manipulator, scenario.load);
  const auto noc = [&](double t) { return noc_subject.torques(scenario.trajectory->at(t)); };
  Subject subject;
  subject.name = file.file.filename().string();
  subject.torques = [&](const Motion<double>& motion) {  // called only at the file's own instants
    const auto row = std::lower_bound(out.file.t.begin(), out.file.t.end(), motion.t) - out.file.t.begin();
    return out.file.torques.at(static_cast<std::size_t>(row));
  };
  out.samples = runPointwise(scenario, subject, out.file.t, deadline);
  for (std::size_t k = 0; k < out.file.rows(); ++k) {
    deadline.require();
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

}  // namespace ursula
