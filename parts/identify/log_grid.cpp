#include "parts/identify/log_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/csv.h"
#include "base/scalar.h"
#include "base/stamped_rows.h"
#include "base/text.h"

namespace ursula::identification {
namespace {

constexpr std::size_t fewest_rows = 16, most_gap = 100'000, head_size = 1000;
/// The grid follows the rows' clock by this share of a row's displacement.
constexpr double follow = 0.1;
/// Rows are skipped up to this step, s, because a motion of some hertz needs it.
constexpr double coarsest = 0.01;
const double turn = 2 * pi, not_there = std::numeric_limits<double>::quiet_NaN();

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
  std::sort(steps.begin(), steps.end());  // the middle half has no gap, and both steps of rounded stamps
  const auto quarter = static_cast<std::ptrdiff_t>(steps.size() / 4);
  step_ = std::accumulate(steps.begin() + quarter, steps.end() - quarter, 0.0) /
          static_cast<double>(static_cast<std::ptrdiff_t>(steps.size()) - 2 * quarter);
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
  if (last_steps_ > 1.5 && last_steps_ < 2 && (t - before_) / step_ < 2.5 && every_ == 1) takeLastForLate();
  if (rows_ == 0) first_t_ = t;
  const double steps = rows_ == 0 ? 1 : (t - grid_t_) / step_;
  const auto jump = static_cast<std::size_t>(std::clamp(std::round(steps), 1.0, 1e9));
  if (jump > most_gap)
    throw CsvError(fmt::format("{}: error: {:.6g} s after the row before, where rows are {:.6g} s apart", place(),
                               t - grid_t_, step_));
  const double off = steps - static_cast<double>(jump);
  jitter_ += off * off;
  gaps_ += jump > 1 ? 1 : 0;
  const std::vector<double> nothing(jump > 1 ? width_ : 0, not_there);
  for (std::size_t i = 1; i < jump; ++i) append(nothing, not_there);
  append(row, t);
  last_ = row;
  end_t_ = t;
  before_ = grid_t_;
  last_steps_ = steps;
  grid_t_ = jump > 1 ? t : t - (1 - follow) * off * step_;
}

/// Closes the gap before the last row, which a row follows too soon for one.
void LogGrid::takeLastForLate() {
  const auto width = static_cast<std::ptrdiff_t>(width_ + 1);
  data_.erase(data_.end() - 2 * width, data_.end() - width);
  --rows_;
  --gaps_;
  jitter_ += 2 * last_steps_ - 3;  // the square of steps − 1 instead of that of steps − 2
  grid_t_ = before_ + (1 + follow * (last_steps_ - 1)) * step_;
}

void LogGrid::append(const std::vector<double>& row, double t) {
  if (rows_++ % every_ != 0) return;
  data_.insert(data_.end(), row.begin(), row.end());
  data_.push_back(t);
  if (data_.size() >= most_log_rows * (width_ + 1) && !isFull()) halve();
}

bool LogGrid::isFull() const { return data_.size() >= most_log_rows * (width_ + 1) && 2 * every_ * step_ > coarsest; }

void LogGrid::halve() {
  const std::size_t width = width_ + 1, half = (data_.size() / width + 1) / 2;
  for (std::size_t i = 1; i < half; ++i)
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(2 * i * width), width,
                data_.begin() + static_cast<std::ptrdiff_t>(i * width));
  data_.resize(half * width);
  every_ *= 2;
}

MeasuredLog LogGrid::finish(const std::string& file, const std::string& first_lacking) {
  const std::string first = first_lacking.empty() ? "" : fmt::format(", the first is {}", first_lacking);
  if (head_.size() > 1) settleHead();
  if (count_ - lacking_ < fewest_rows)
    throw CsvError(fmt::format("{}: error: {} row{}{}, expected at least {}", shownPath(file), count_ - lacking_,
                               count_ - lacking_ == 1 ? "" : "s",
                               lacking_ > 0 ? " without an empty or NaN cell" + first : "", fewest_rows));
  MeasuredLog log;
  log.file = file;
  log.file_rows = count_;
  log.every = every_;
  EvenRows grid{first_t_, (end_t_ - first_t_) / static_cast<double>(rows_ - 1) * every_, {}, {}, {}};
  StampedRows rows(std::move(data_), width_ + 1, grid.step);
  const bool even = rows.areEven();
  if (even) rows.takeAsEven(grid);
  rows.moveTo(grid);
  log.start = grid.start;
  log.step = grid.step;
  log.file_step = grid.step / every_;
  log.motion = std::move(grid.values);
  log.missing = std::move(grid.missing);
  log.filled = std::move(grid.filled);
  note(log, even, first);
  return log;
}

void LogGrid::note(MeasuredLog& log, bool even, const std::string& first) const {
  if (left_out_ > 0)
    log.findings.push_back({"long", -1, static_cast<double>(left_out_), "rows",
                            fmt::format("the rows up to t = {:.6g} s are used; {} more are left out, because steps "
                                        "beyond {:g} s would hide the motion",
                                        end_t_, left_out_, coarsest)});
  const std::size_t used = count_ - left_out_;
  if (const std::size_t filled = rows_ - (used - lacking_); filled > 0)
    log.findings.push_back(
        {"drop_outs", -1, static_cast<double>(filled), "rows",
         fmt::format("of {} rows {} are missing (gaps: {}) and {} have empty or NaN cells{}; up to {} "
                     "in a row are filled by a polynomial, what is near longer gaps is left out",
                     rows_, rows_ - used, gaps_, lacking_, first, most_filled_rows)});
  if (const double jitter = std::sqrt(jitter_ / static_cast<double>(rows_)); jitter > 0.05)
    log.findings.push_back(
        {"jitter", -1, jitter, "steps",
         fmt::format("instants are off a grid of {:.6g} s by {:.2g} of a step (rms); {}", log.file_step, jitter,
                     even ? "the motion's rows are even, so they are taken to be on it"
                          : "each row is used at its own instant")});
}

}  // namespace ursula::identification
