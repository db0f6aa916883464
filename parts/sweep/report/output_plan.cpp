#include "parts/sweep/report/sweep_outputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Whether it is the instant of a largest effort, which is in the table, but whose distribution means nothing.
bool isInstant(const std::string& name) { return name.size() > 4 && name.compare(name.size() - 4, 4, "_t_s") == 0; }

SweepOutput outputOf(bool validates, const std::string& name) {
  SweepOutput out;
  out.name = name;
  if (validates) {
    out.kind = OutputKind::check_share;
  } else if (name.size() > 6 && name.compare(0, 4, "tau_") == 0 && name[5] == '_' && name[4] >= '1' && name[4] <= '6') {
    out.kind = OutputKind::effort;
    out.motor = name[4] - '1';
    out.unit = name.substr(6);
  } else if (name == "kappa_B") {
    out.kind = OutputKind::kappa;
  } else if (name == "sin_theta" || name == "sin_psi" || name == "cos_theta" || name == "leg_margin") {
    out.kind = OutputKind::sine;
  }
  return out;
}

double shareOf(const SweepRow::Value& value) {
  return std::isnan(value.value) || std::isnan(value.limit) ? no_value : WorstShare::share(value.value, value.limit);
}

}  // namespace

OutputPlan::OutputPlan(bool validates, const std::vector<std::string>& names)
    : place_(names.size(), nowhere), group_(names.size(), nowhere) {
  std::vector<SweepOutput> single;
  for (const std::string& name : names) single.push_back(outputOf(validates, name));
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == "refused_leg") refused_leg_ = k;
    if (single[k].kind == OutputKind::check_share) group_[k] = groupOf(OutputKind::largest_share, "");
    if (single[k].kind == OutputKind::effort && !isInstant(names[k]))
      group_[k] = groupOf(OutputKind::largest_effort, single[k].unit);
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (isInstant(names[k]) || k == refused_leg_) continue;
    place_[k] = outputs_.size();
    outputs_.push_back(single[k]);
  }
  outputs_.push_back({OutputKind::not_passed});
}

std::size_t OutputPlan::groupOf(OutputKind kind, const std::string& unit) {
  const auto at = std::find_if(outputs_.begin(), outputs_.end(),
                               [&](const SweepOutput& each) { return each.kind == kind && each.unit == unit; });
  if (at != outputs_.end()) return at - outputs_.begin();
  outputs_.push_back({kind, "", unit});
  return outputs_.size() - 1;
}

void OutputPlan::evaluate(const SweepRow& row, std::vector<double>& values) const {
  values.assign(outputs_.size(), no_value);
  values.back() = row.verdict == "pass" ? 0 : 1;
  for (const SweepRow::Value& each : row.values) {
    const std::size_t place = place_[each.name], group = group_[each.name];
    if (place == nowhere) continue;
    values[place] = outputs_[place].kind == OutputKind::check_share ? shareOf(each) : each.value;
    if (group != nowhere && !std::isnan(values[place]) && !(values[group] >= values[place]))
      values[group] = values[place];
  }
}

std::size_t OutputPlan::largestOf(const std::vector<double>& values) const {
  const SweepOutput& group = outputs_.front();
  const OutputKind member = group.kind == OutputKind::largest_share ? OutputKind::check_share : OutputKind::effort;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (outputs_[k].kind == member && outputs_[k].unit == group.unit && values[k] == values[0]) return k;
  return 0;
}

int OutputPlan::refusedLeg(const SweepRow& row) const {
  for (const SweepRow::Value& each : row.values)
    if (each.name == refused_leg_ && each.value >= 1 && each.value <= 6) return static_cast<int>(each.value);
  return 0;
}

}  // namespace ursula
