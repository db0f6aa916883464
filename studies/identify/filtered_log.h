#pragma once

#include <vector>

#include "studies/identify/platform_motion.h"
#include "studies/identify/signals.h"

namespace ursula::identification {

/// How a log goes on beyond its ends.
enum class Ends { open, rest, period };

/// Whether a motion that is no period begins and ends at rest, so that it may be taken to rest before and after.
Ends endsOf(const MeasuredLog& log, bool is_period);

/// How a log is filtered. A low pass that leaves the motion as it is gives it and its rates every `coarse` rows;
/// another acts alike on measured efforts, on the model's and on every column of the regressor, and is looked at every
/// `fine` of those: there white noise is as good as uncorrelated.
struct FilterPlan {
  double bandwidth = 0;                  ///< of the motion, Hz
  double state_cut = 0, effort_cut = 0;  ///< Hz
  Eigen::Index coarse = 1, fine = 1;
  Ends ends = Ends::open;
  bool too_slow = false;  ///< the log's rate does not reach far enough above the motion's bandwidth
};
FilterPlan planFilters(const MeasuredLog& log, Ends ends);

/// Instants first … end − 1 that follow each other without a gap.
struct Segment {
  Eigen::Index first = 0, end = 0;
};

/// A log after its low passes.
class FilteredLog {
 public:
  /// The most instants that are looked at; of longer logs parts are taken all over.
  static constexpr Eigen::Index most_instants = 20'000;

  /// Efforts may be asked for up to `reach` s later or earlier.
  FilteredLog(const MeasuredLog& log, const FilterPlan& plan, double reach);

  Eigen::Index size() const { return static_cast<Eigen::Index>(centers_.size()); }
  double step() const { return log_.step * static_cast<double>(plan_.coarse); }
  double time(Eigen::Index i) const;
  MeasuredState state(Eigen::Index i) const;
  /// The same by a low pass with a higher cut-off.
  MeasuredState sharperState(Eigen::Index i) const;
  Vector6d load(Eigen::Index i) const;
  const std::vector<Segment>& segments() const { return segments_; }
  /// Efforts at the motion's instants.
  Eigen::MatrixXd efforts() const;
  /// Efforts `shift` s later than the settled instants.
  Eigen::MatrixXd settledEfforts(double shift) const;
  /// What efforts are low-passed by, of series at the motion's instants: rows at those that settled() lists.
  Eigen::MatrixXd settle(const Eigen::MatrixXd& series) const { return settleBy(second_.value, series); }
  Eigen::MatrixXd settleBy(const Eigen::VectorXd& weights, const Eigen::MatrixXd& series) const;
  const std::vector<Eigen::Index>& settled() const { return settled_; }
  /// Of the settled instants.
  const std::vector<Segment>& settledSegments() const { return settled_segments_; }
  const Kernel& first() const { return first_; }
  const Kernel& second() const { return second_; }
  const FilterPlan& plan() const { return plan_; }

 private:
  void placeCenters(double reach);
  void placeSettled();

  MeasuredLog log_;  ///< of a period with its ends carried on
  FilterPlan plan_;
  Kernel first_, second_, sharper_;
  Eigen::Index before_ = 0;  ///< rows carried on before the first
  std::vector<Eigen::Index> centers_, settled_;
  std::vector<Segment> segments_, settled_segments_;
  Eigen::MatrixXd value_, rate_, acceleration_, load_;
};

}  // namespace ursula::identification
