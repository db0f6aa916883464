#include "studies/identify/log_grid.h"

#include "base/shown_text.h"

namespace ursula::identification {

MeasuredLog LogGrid::finish(const std::string& file) {
  if (count_ < fewest_rows)
    throw CsvError(fmt::format("{}: error: {} rows, expected at least {}", shownPath(file), count_, fewest_rows));
  if (rows_ == 0) settleHead();
  MeasuredLog log;
  log.file = file;
  log.file_rows = count_;
  log.averaged = collector_.averaged;
  log.file_step = (grid_t_ - first_t_) / static_cast<double>(rows_ - 1);
  log.step = log.file_step * log.averaged;
  log.start = first_t_ + 0.5 * (log.averaged - 1) * log.file_step;
  const auto rows = static_cast<Eigen::Index>(collector_.rows());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  log.motion = Eigen::Map<const Rows>(collector_.data.data(), rows, static_cast<Eigen::Index>(width_));
  log.missing.assign(static_cast<std::size_t>(rows), false);
  for (std::size_t k = 0; k < missing_.size(); ++k)
    if (missing_[k] && k / static_cast<std::size_t>(log.averaged) < log.missing.size())
      log.missing[k / static_cast<std::size_t>(log.averaged)] = true;
  const std::size_t filled = rows_ - count_ + lacking_;
  if (filled > 0)
    log.findings.push_back(
        {"drop_outs", -1, static_cast<double>(filled), "rows",
         fmt::format(
             "{} of {} rows are missing, in {} gaps and {} rows with empty cells; what is near them is left out",
             filled, rows_, gaps_, lacking_)});
  if (const double jitter = std::sqrt(jitter_ / static_cast<double>(rows_)); jitter > 0.05)
    log.findings.push_back(
        {"jitter", -1, jitter, "steps",
         fmt::format("instants are off a grid of {:.6g} s by {:.2g} of a step (rms); they are taken to be on it",
                     log.file_step, jitter)});
  return log;
}

}  // namespace ursula::identification
