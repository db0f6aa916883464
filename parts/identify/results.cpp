#include "parts/identify/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "model/torque_names.h"
#include "validation/verdict/worst_share.h"

namespace ursula::identification {
namespace {

constexpr std::size_t most_terms_in_words = 4;

std::string groupOf(const Direction& direction) {
  if (direction.kind == DirectionKind::offset) return "offset";
  if (direction.kind == DirectionKind::delay) return "delay";
  const auto has = [&](const char* word) { return direction.path.find(word) != std::string::npos; };
  if (has("rotor_inertia")) return "rotor";
  if (has("friction") || has("coulomb")) return "friction";
  if (has("first_moment")) return "center";
  return has("inertia") ? "inertia" : "mass";
}

void addColumn(TimeSeries& series, const std::string& name, const Eigen::VectorXd& values) {
  series.add(name, {values.data(), values.data() + values.size()});
}

MeasuredNumber withInterval(MeasuredNumber number, double quantile) {
  number.low = number.value - quantile * number.uncertainty;
  number.high = number.value + quantile * number.uncertainty;
  return number;
}

std::string motorColumn(const char* what, int k, const std::string& unit) {
  return fmt::format("{}_{}_{}", what, k + 1, unit);
}

}  // namespace

std::string wordsOf(const Direction& direction) {
  static const std::regex form(R"(manipulator\.(?:platform|leg\.(\d+))(?:\.(proximal|distal))?\.(\w+)(?:\.(\w+))?)");
  static constexpr const char *axes[] = {" x", " y", " z"}, *entries[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
  std::smatch part;
  if (!std::regex_match(direction.path, part, form)) return direction.words;
  const std::string leg = part[1], link = part[2], quantity = part[3], entry = part[4];
  const std::string of = leg.empty()    ? " of the platform"
                         : link.empty() ? " of leg " + leg
                                        : fmt::format(" of leg {}'s {} link", leg, link);
  const auto of_entry = [&](const char* const* names) { return entry.empty() ? "" : names[std::stoul(entry)]; };
  if (quantity == "mass") return "mass" + of;
  if (quantity == "first_moment") return fmt::format("mass × mass centre{}{}", of_entry(axes), of);
  if (quantity == "inertia_at_P") return fmt::format("inertia {}{} about P", of_entry(entries), of);
  if (quantity == "inertia_at_end") return fmt::format("inertia {}{} about its first end", of_entry(entries), of);
  if (quantity == "rotor_inertia") return fmt::format("rotor inertia on {}{}", entry, of);
  if (quantity == "friction") return fmt::format("viscous friction on {}{}", entry, of);
  if (quantity == "coulomb") return fmt::format("Coulomb friction on {}{}", entry, of);
  return direction.words;
}

void addCombinations(const BaseFit& fit, const Comparison& comparison, IdentifyResult& out) {
  for (const BaseParameter& base : fit.parameters) {
    const Direction& first = comparison.directions[base.terms.front().first];
    MeasuredNumber number{"", groupOf(first), first.unit, stated(base.nominal), base.value, base.deviation};
    auto terms = base.terms;
    if (first.kind == DirectionKind::delay) {  // it has its own fit, within the numbers' tolerances
      number.value = out.delay;
      number.uncertainty = out.delay_uncertainty;
      terms.resize(1);
    }
    std::sort(terms.begin() + 1, terms.end(), [&](const auto& a, const auto& b) {
      const auto size = [&](const auto& term) {
        return std::abs(term.second) * comparison.directions[term.first].plausible;
      };
      return size(a) > size(b);
    });
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const Direction& direction = comparison.directions[terms[k].first];
      number.terms.emplace_back(direction.name(), terms[k].second);
      if (k < most_terms_in_words)
        number.name += k == 0 ? wordsOf(direction)
                              : fmt::format(" {} {:.4g} × {}", terms[k].second < 0 ? "−" : "+",
                                            std::abs(terms[k].second), wordsOf(direction));
    }
    if (terms.size() > most_terms_in_words) number.name += " + …";
    out.combinations.push_back(withInterval(number, fit.quantile));
  }
  for (const Eigen::Index j : fit.unseen) out.unseen.push_back(wordsOf(comparison.directions[j]));
}

void addNumbers(const std::vector<NumberEstimate>& estimates, double quantile, IdentifyResult& out) {
  for (const NumberEstimate& each : estimates)
    if (each.before != 0 || each.measured.tolerance >= 0) out.numbers.push_back(withInterval(each.measured, quantile));
}

void addEfforts(const Comparison& comparison, const Eigen::MatrixXd& u_val, IdentifyResult& out) {
  addColumn(out.series, "t_s", comparison.t);
  for (int k = 0; k < motor_count; ++k) {
    const std::string unit = out.motors[k].unit;
    addColumn(out.series, motorColumn("tau", k, unit), comparison.measured.col(k));
    addColumn(out.series, motorColumn("model", k, unit), comparison.model.col(k));
    addColumn(out.series, motorColumn("u_val", k, unit), u_val.col(k));
  }
}

void addSeries(const Comparison& comparison, const BaseFit& fit, const FilteredLog& filtered, IdentifyResult& out) {
  const double step = filtered.step() * static_cast<double>(filtered.plan().fine);
  for (int k = 0; k < motor_count; ++k) {
    const std::string unit = out.motors[k].unit;
    const Eigen::VectorXd change = comparison.columns[k].leftCols(fit.step.size()) * fit.step;
    const Eigen::VectorXd fitted = comparison.model.col(k) + change;
    addColumn(out.series, motorColumn("fitted", k, unit), fitted);
    const Eigen::VectorXd spectrum = powerSpectrum(comparison.measured.col(k) - fitted, step);
    if (k == 0) addColumn(out.spectra, "f_Hz", Eigen::VectorXd::LinSpaced(spectrum.size(), 0, 0.5 / step));
    addColumn(out.spectra, motorColumn("residual", k, unit + "2_Hz"), spectrum);
  }
}

namespace {

std::string causeWords(const MeasuredCause& cause) {
  if (cause.misread) return cause.what;
  const std::string unit = cause.unit.empty() ? "" : " " + cause.unit;
  std::string out =
      fmt::format("{} is {:.6g} ± {:.2g}{} instead of {:.6g}{}", cause.parameter.empty() ? cause.what : cause.parameter,
                  cause.found, 1.96 * cause.uncertainty, unit, cause.expected, unit);
  if (cause.tolerances != 0) out += fmt::format(", {:.3g} of its tolerances", std::abs(cause.tolerances));
  return cause.outside ? out + ", which no mass, inertia or friction can be" : out;
}

}  // namespace

std::string identifySentence(const IdentifyResult& result) {
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t k = 0; k < result.motors.size(); ++k)
    if (const double share = result.motors[k].deviation / std::max(result.motors[k].u_val, 1e-300);
        exceeds(share, worst)) {
      worst = share;
      at = k;
    }
  const MotorAgreement& motor = result.motors[at];
  const std::string size = fmt::format(
      "motor {}, the worst, was measured {:.3g} {} (rms) off the model, at a standard "
      "uncertainty of {:.3g} {}",
      at + 1, motor.deviation, motor.unit, motor.u_val, motor.unit);
  if (result.verdict == Verdict::pass) return "The model agrees within its uncertainty at 95 %: " + size + ".";
  std::string out = (result.verdict == Verdict::fail ? "The model is wrong: " : "Not judged: ") + size + ".";
  if (result.causes.empty()) return out + (result.verdict == Verdict::fail ? " No single number explains it." : "");
  if (result.causes.front().misread) return out + " Likely cause: " + result.causes.front().what + ".";
  out += result.causes.size() == 1 ? " Likely cause: " : " Likely causes: ";
  for (std::size_t k = 0; k < result.causes.size(); ++k) out += (k == 0 ? "" : "; ") + causeWords(result.causes[k]);
  return out + ".";
}

}  // namespace ursula::identification
