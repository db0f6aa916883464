#include "parts/identify/log_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/csv.h"
#include "base/scalar.h"
#include "base/text.h"

namespace ursula::identification {
namespace {

constexpr std::size_t fewest_rows = 16, most_gap = 100'000, head_size = 1000;
/// A cubic through two rows on either side fills gaps of up to this many rows, because links drop single rows often.
constexpr std::size_t most_filled = 3;
/// Rows are skipped up to this step, s, because a motion of some hertz needs it.
constexpr double coarsest = 0.01;
const double turn = 2 * pi;

}  // namespace

void LogGrid::add(double t, std::vector<double>& row, const Place& place) {
  if (count_ > 0 && !(t > last_t_))
    throw CsvError(fmt::format("{}: error: t = {} s {} {} s of the row before, expected increasing instants", place(),
                               t, t == last_t_ ? "repeats" : "comes after", last_t_));
  last_t_ = t;
  if (++count_ <= head_size) {
    head_.emplace_back(t, row);
    return;
  }
  if (!head_.empty()) settleHead();
  put(t, row, place);
}

void LogGrid::settleHead() {
  std::vector<double> steps;
  for (std::size_t k = 1; k < head_.size(); ++k) steps.push_back(head_[k].first - head_[k - 1].first);
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  step_ = steps[steps.size() / 2];
  for (auto& each : head_) put(each.first, each.second, [&] { return fmt::format("t = {} s", each.first); });
  head_.clear();
}

void LogGrid::put(double t, std::vector<double>& row, const Place& place) {
  if (isFull()) {
    ++left_out_;
    return;
  }
  if (std::any_of(row.begin(), row.end(), [](double x) { return std::isnan(x); })) {
    ++lacking_;
    return;
  }
  for (const std::size_t k : turning_)
    if (rows_ > 0) row[k] -= turn * std::round((row[k] - last_[k]) / turn);
  if (rows_ == 0) first_t_ = t;
  const double steps = rows_ == 0 ? 1 : (t - grid_t_) / step_;
  const auto jump = static_cast<std::size_t>(std::clamp(std::round(steps), 1.0, 1e9));
  if (jump > most_gap)
    throw CsvError(fmt::format("{}: error: {:.6g} s after the row before, where rows are {:.6g} s apart", place(),
                               t - grid_t_, step_));
  if (jump == 1) jitter_ += (steps - 1) * (steps - 1);
  gaps_ += jump > 1 ? 1 : 0;
  std::vector<double> between(jump > 1 ? width_ : 0);
  for (std::size_t i = 1; i < jump; ++i) {
    for (std::size_t k = 0; k < width_; ++k)
      between[k] = last_[k] + static_cast<double>(i) / static_cast<double>(jump) * (row[k] - last_[k]);
    append(between, true);
  }
  append(row, false);
  last_ = row;
  grid_t_ = t;
}

void LogGrid::append(const std::vector<double>& row, bool missing) {
  missing_.push_back(missing);
  if (rows_++ % every_ != 0) return;
  data_.insert(data_.end(), row.begin(), row.end());
  if (data_.size() >= most_log_rows * width_ && !isFull()) halve();
}

bool LogGrid::isFull() const { return data_.size() >= most_log_rows * width_ && 2 * every_ * step_ > coarsest; }

void LogGrid::halve() {
  const std::size_t half = (data_.size() / width_ + 1) / 2;
  for (std::size_t i = 1; i < half; ++i)
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(2 * i * width_), width_,
                data_.begin() + static_cast<std::ptrdiff_t>(i * width_));
  data_.resize(half * width_);
  every_ *= 2;
}

std::vector<std::size_t> LogGrid::neighboursOf(std::size_t first, std::size_t end) const {
  constexpr std::size_t reach = 6;
  std::vector<std::size_t> out;
  for (std::size_t k = first; k-- > 0 && first - k <= reach && out.size() < 2;)
    if (!missing_[k]) out.push_back(k);
  const std::size_t before = out.size();
  for (std::size_t k = end; k < missing_.size() && k - end < reach && out.size() < before + 2; ++k)
    if (!missing_[k]) out.push_back(k);
  return before == 2 && out.size() == 4 ? out : std::vector<std::size_t>();
}

void LogGrid::markGaps(MeasuredLog& log) const {
  const auto every = static_cast<std::size_t>(log.every);
  for (std::size_t first = 0; first < missing_.size(); ++first) {
    if (!missing_[first]) continue;
    const auto after = std::find(missing_.begin() + static_cast<std::ptrdiff_t>(first), missing_.end(), false);
    const auto end = static_cast<std::size_t>(after - missing_.begin());
    const std::vector<std::size_t> nodes = neighboursOf(first, end);
    const bool stays = end - first > most_filled || nodes.empty();
    for (std::size_t k = first; k < end && k / every < log.missing.size(); ++k) {
      if (stays) log.missing[k / every] = true;
      if (stays || every > 1) continue;
      log.filled.resize(log.missing.size(), false);
      log.filled[k] = true;
      Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(log.motion.cols());
      for (const std::size_t node : nodes) {  // Lagrange's cubic
        double weight = 1;
        for (const std::size_t other : nodes)
          if (other != node)
            weight *= (static_cast<double>(k) - static_cast<double>(other)) /
                      (static_cast<double>(node) - static_cast<double>(other));
        sum += weight * log.motion.row(static_cast<Eigen::Index>(node));
      }
      log.motion.row(static_cast<Eigen::Index>(k)) = sum;
    }
    first = end;
  }
}

MeasuredLog LogGrid::finish(const std::string& file) {
  if (head_.size() > 1) settleHead();
  if (count_ - lacking_ < fewest_rows)
    throw CsvError(fmt::format("{}: error: {} row{}{}, expected at least {}", shownPath(file), count_ - lacking_,
                               count_ - lacking_ == 1 ? "" : "s", lacking_ > 0 ? " without an empty cell" : "",
                               fewest_rows));
  MeasuredLog log;
  log.file = file;
  log.file_rows = count_;
  log.every = every_;
  log.file_step = (grid_t_ - first_t_) / static_cast<double>(rows_ - 1);
  log.step = log.file_step * every_;
  log.start = first_t_;
  const std::size_t rows = data_.size() / width_;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  log.motion = Eigen::Map<const Rows>(data_.data(), static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(width_));
  log.missing.assign(rows, false);
  markGaps(log);
  if (left_out_ > 0)
    log.findings.push_back({"long", -1, static_cast<double>(left_out_), "rows",
                            fmt::format("the rows up to t = {:.6g} s are used; {} more are left out, because steps "
                                        "beyond {:g} s would hide the motion",
                                        grid_t_, left_out_, coarsest)});
  const std::size_t used = count_ - left_out_;
  if (const std::size_t filled = rows_ - (used - lacking_); filled > 0)
    log.findings.push_back({"drop_outs", -1, static_cast<double>(filled), "rows",
                            fmt::format("of {} rows {} are missing (gaps: {}) and {} have empty cells; up to {} in a "
                                        "row are filled by a cubic, what is near longer gaps is left out",
                                        rows_, rows_ - used, gaps_, lacking_, most_filled)});
  if (const double jitter = std::sqrt(jitter_ / static_cast<double>(rows_)); jitter > 0.05)
    log.findings.push_back(
        {"jitter", -1, jitter, "steps",
         fmt::format("instants are off a grid of {:.6g} s by {:.2g} of a step (rms); they are taken to be on it",
                     log.file_step, jitter)});
  return log;
}

}  // namespace ursula::identification
