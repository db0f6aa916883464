#pragma once

#include <vector>

#include "parts/identify/platform_motion.h"
#include "parts/identify/signals.h"

namespace ursula::identification {

/// A plan has two low passes. The first passes the whole motion and gives it with its rates every `coarse` rows; a
/// period has a Fourier series instead. The second acts alike on measured efforts, modelled efforts and every column of
/// the regressor. It is sampled every `fine` of those rows, at which white noise is nearly uncorrelated.
struct FilterPlan {
  double bandwidth = 0;                  ///< bandwidth of the motion, Hz
  double state_cut = 0, effort_cut = 0;  ///< Hz
  Eigen::Index coarse = 1, fine = 1;
  bool is_period = false;  ///< the log is one period of a motion that repeats
  bool too_slow = false;   ///< the log's rate is too low for the motion's bandwidth
  SampleNoise noise;
  FourierSeries series;  ///< the motion of a period, instead of the first low pass
};
FilterPlan planFilters(const MeasuredLog& log, bool is_period, const SampleNoise& noise);

/// Consecutive instants first … end − 1 without a gap.
struct Segment {
  Eigen::Index first = 0, end = 0;
};

/// A log after its low passes.
class FilteredLog {
 public:
  /// Largest number of instants; a longer log is sampled in parts over its whole length.
  static constexpr Eigen::Index most_instants = 20'000;

  /// Allows efforts up to `reach` s later or earlier.
  FilteredLog(const MeasuredLog& log, const FilterPlan& plan, double reach);

  Eigen::Index size() const { return static_cast<Eigen::Index>(centers_.size()); }
  double step() const { return log_.step * static_cast<double>(plan_.coarse); }
  double time(Eigen::Index i) const;
  const MeasuredState& state(Eigen::Index i) const { return states_[i]; }
  /// Takes this noise out of the motion, instead of what was taken out before. Each row has an instant's value, rate
  /// and acceleration of all channels.
  void takeOut(const Eigen::MatrixXd& noise);
  const Eigen::MatrixXd& taken() const { return taken_; }
  /// Returns the motion by the sharper low pass, which has a higher cut-off.
  MeasuredState sharperState(Eigen::Index i) const;
  /// Returns what the sharper low pass adds to efforts at the motion's instants. It adds nothing if the motion is a
  /// period.
  Eigen::MatrixXd sharperEfforts() const;
  /// Returns the load of a log that has one.
  Vector6d load(Eigen::Index i) const { return load_.row(i).transpose(); }
  /// Returns efforts `shift` s later than the motion's instants, after a low pass like the motion's.
  Eigen::MatrixXd efforts(double shift) const;
  /// Returns efforts `shift` s later than the settled instants.
  Eigen::MatrixXd settledEfforts(double shift) const;
  /// Applies the efforts' low pass to series at the motion's instants. Returns the rows at settled().
  Eigen::MatrixXd lowPass(const Eigen::MatrixXd& series) const { return lowPassBy(second_.value, series); }
  Eigen::MatrixXd lowPassBy(const Eigen::VectorXd& weights, const Eigen::MatrixXd& series) const;
  const std::vector<Eigen::Index>& settled() const { return settled_; }
  /// Returns the segments of the settled instants.
  const std::vector<Segment>& settledSegments() const { return settled_segments_; }
  /// Frequencies, rad/s, and weights of noise after low passes. The weighted cosines of a time add up to the covariance
  /// over that time.
  struct Lines {
    std::vector<double> omega, weight;

    /// Returns the covariance of value, rate and acceleration (rows) with those `later` s later (columns).
    Eigen::Matrix3d covariance(double later) const;
  };
  /// Returns the lines of what white noise of deviation 1 on the samples leaves in the settled efforts.
  Lines effortLines() const;
  /// Returns the same lines for the motion. The second low pass acts at none, one or both of the two instants:
  /// `second_passes` is 0, 1 or 2.
  Lines motionLines(int second_passes = 2) const;
  /// Returns the same lines for what the sharper low pass passes in addition.
  Lines sharperLines() const;
  /// Returns the time beyond which noise is uncorrelated, s.
  double memory() const;
  const Kernel& second() const { return second_; }
  const FilterPlan& plan() const { return plan_; }

 private:
  template <class Power>
  Lines linesOf(double spacing, double end, const Power& power) const;
  void placeCenters(double reach);
  void placeSettled();
  std::vector<MeasuredState> statesBy(const Kernel& kernel, const std::vector<Eigen::Index>& rows) const;

  MeasuredLog log_;  ///< a period is extended beyond its ends
  FilterPlan plan_;
  Kernel first_, second_, sharper_;
  Eigen::Index before_ = 0;  ///< rows added before the first
  std::vector<Eigen::Index> centers_, settled_;
  std::vector<Segment> segments_, settled_segments_;
  std::vector<MeasuredState> states_;
  Eigen::MatrixXd load_, taken_;
};

}  // namespace ursula::identification
