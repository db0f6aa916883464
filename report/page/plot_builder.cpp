#include "report/page/plots.h"

#include <algorithm>
#include <utility>

#include "report/text/quantity.h"

namespace ursula::report {

std::vector<std::size_t> ascending(const std::vector<double>& x) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isfinite(x[i])) rows.push_back(i);
  }
  std::stable_sort(rows.begin(), rows.end(), [&x](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  return rows;
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const std::size_t row : rows) {
    result.push_back(row < values.size() ? values[row] : std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

TimePlots::TimePlots(const TimeSeries& series, std::vector<Plot>& plots, std::vector<std::string> names)
    : series_(series), plots_(plots), names_(std::move(names)) {
  const std::vector<double>* t = series.find("t_s");
  if (t == nullptr) return;
  rows_ = ascending(*t);
  t_ = picked(*t, rows_);
}

Plot TimePlots::plot(PlotGroup group, const std::string& title, const std::string& y_label, bool log_y) const {
  Plot plot;
  plot.title = title;
  plot.group = group;
  plot.x_label = "t (s)";
  plot.y_label = y_label;
  plot.log_y = log_y;
  plot.over_time = true;
  plot.x = t_;
  plot.rows = t_.size();
  return plot;
}

void TimePlots::addColumn(Plot& plot, const std::string& column, Line line, double factor) const {
  const std::vector<double>* values = series_.find(column);
  if (values == nullptr) return;
  line.values = picked(*values, rows_);
  if (factor != 1)
    for (double& value : line.values) value *= factor;
  plot.lines.push_back(std::move(line));
}

void TimePlots::addValues(Plot& plot, const std::vector<double>& values, Line line) const {
  line.values = picked(values, rows_);
  plot.lines.push_back(std::move(line));
}

std::string TimePlots::label(const std::string& symbol, const std::string& index) const {
  const auto k = static_cast<std::size_t>(std::stoul(index));
  return k >= 1 && k <= names_.size() ? names_[k - 1] : symbol + subscript(index);
}

std::string TimePlots::motor(const std::string& index) const {
  const auto k = static_cast<std::size_t>(std::stoul(index));
  return k >= 1 && k <= names_.size() ? names_[k - 1] : "Motor " + index;
}

void TimePlots::addIndexed(Plot& plot, const std::string& quantity, const std::string& symbol, bool ghost) const {
  int color = 0;
  for (const Indexed& column : indexed(series_, quantity)) {
    const std::string label = this->label(symbol, column.index) + (ghost ? " expected" : "");
    addValues(plot, *column.values,
              {label, prettyUnit(column.unit), color++, ghost ? Stroke::ghost : Stroke::line, {}});
  }
}

void TimePlots::keep(Plot plot) {
  if (!plot.lines.empty() && !plot.x.empty()) plots_.push_back(std::move(plot));
}

std::string subscript(const std::string& index) {
  const char* const digits[] = {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};
  std::string out;
  for (const char c : index) out += c >= '0' && c <= '9' ? digits[c - '0'] : std::string(1, c);
  return out;
}

std::vector<Indexed> indexed(const TimeSeries& series, const std::string& quantity) {
  std::vector<Indexed> out;
  for (std::size_t k = 0; k < series.names.size(); ++k) {
    const std::string& name = series.names[k];
    if (name.rfind(quantity + "_", 0) != 0) continue;
    const std::size_t from = quantity.size() + 1, to = name.find('_', from);
    const std::string index = name.substr(from, to == std::string::npos ? to : to - from);
    const bool is_number = !index.empty() && index.find_first_not_of("0123456789") == std::string::npos;
    if (is_number) out.push_back({index, to == std::string::npos ? "" : name.substr(to + 1), &series.columns[k]});
  }
  return out;
}

}  // namespace ursula::report
