#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/csv.h"
#include "base/errors.h"
#include "base/text.h"
#include "model/mechanism_scenario.h"
#include "model/motor_table.h"

namespace ursula {
namespace {

/// Refuses derivatives that contradict what they belong to. Between two instants the mean slope is a derivative's value
/// there; it lies within the range of the nearest four derivatives, as far as that range goes on either side. Friction
/// and efforts may change more between two rows, but not between most of the rows around.
class Derivatives {
 public:
  Derivatives(const CsvTable& table, const std::vector<double>& half) : table_(table), half_(half) {
    const auto [least, most] = spacing();
    // Evenly spaced instants are exact, however few digits they have.
    stamps_ = std::min(2 * half_[indexOf(t_)], most - least);
  }

  /// Throws CsvError with the row.
  void require(const std::vector<double>& values, const std::vector<double>& rates) const {
    if (t_.size() < 4) return;
    double most = 0;
    for (const double each : values) most = std::max(most, std::abs(each));
    for (std::size_t i = 0; i + 1 < t_.size(); ++i) {
      const auto first = rates.begin() + static_cast<std::ptrdiff_t>(std::min(i == 0 ? 0 : i - 1, t_.size() - 4));
      const auto [low, high] = std::minmax_element(first, first + 4);
      const double h = t_[i + 1] - t_[i], slope = (values[i + 1] - values[i]) / h;
      const double rounding = 2 * half_[indexOf(values)] + stamps_ * std::abs(slope) + 1e-15 * most;
      const double slack = *high - *low + half_[indexOf(rates)] + rounding / h + 1e-12 * std::abs(slope);
      if (h > 0 && !(slope >= *low - slack && slope <= *high + slack) && isOffAround(values, rates, i))
        refuse(values, rates, i, slope);
    }
  }

 private:
  /// Whether most rises around row i differ from the means of their rates by a share that no event explains.
  bool isOffAround(const std::vector<double>& values, const std::vector<double>& rates, std::size_t i) const {
    constexpr std::size_t reach = 8;
    constexpr double share = 0.03;
    const std::size_t first = i > reach ? i - reach : 0, last = std::min(i + reach, t_.size() - 2);
    std::size_t off = 0;
    for (std::size_t j = first; j <= last; ++j) {
      const double rise = values[j + 1] - values[j], mean = (rates[j] + rates[j + 1]) / 2 * (t_[j + 1] - t_[j]);
      if (!(std::abs(rise - mean) <= share * std::max(std::abs(rise), std::abs(mean)))) ++off;
    }
    return 2 * off > last - first + 1;
  }

  std::size_t indexOf(const std::vector<double>& column) const { return &column - table_.columns.data(); }
  const std::string& nameOf(const std::vector<double>& column) const { return table_.names[indexOf(column)]; }

  std::pair<double, double> spacing() const {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (std::size_t i = 0; i + 1 < t_.size(); ++i) {
      least = std::min(least, t_[i + 1] - t_[i]);
      most = std::max(most, t_[i + 1] - t_[i]);
    }
    return {std::min(least, most), most};
  }

  [[noreturn]] void refuse(const std::vector<double>& values, const std::vector<double>& rates, std::size_t i,
                           double slope) const {
    throw CsvError(
        fmt::format("{}: error: {} is {:.6g} at t = {:.6g} s, but {} changes by {:.6g} a second from there to the next "
                    "row, expected its derivative; without the column it is taken from {}",
                    table_.place(i), nameOf(rates), rates[i], t_[i], nameOf(values), slope, nameOf(values)));
  }

  const CsvTable& table_;
  const std::vector<double>& half_;
  const std::vector<double>& t_ = table_.at("t_s");
  double stamps_ = 0;  ///< by which two instants may be nearer or farther than printed, s
};

/// Throws CsvError if rates or accelerations of a motor are no derivatives.
void requireDerivatives(const CsvTable& table, const Mechanism& mechanism, const std::vector<double>& half) {
  const Derivatives derivatives(table, half);
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
    for (const auto& [of, by] : {std::pair("q", "qdot"), {"qdot", "qddot"}}) {
      const auto* values = table.find(motorColumn(mechanism, k, of));
      const auto* rates = table.find(motorColumn(mechanism, k, by));
      if (values != nullptr && rates != nullptr) derivatives.require(*values, *rates);
    }
}

}  // namespace

MotorSamples readMotorSamples(const std::filesystem::path& file, const Mechanism& mechanism,
                              const std::vector<std::string>& map) {
  const MotorTable found = readMotorTable(file, mechanism, map);
  const CsvTable& read = found.table;
  const std::vector<double>& half = found.half_digits;
  const Eigen::MatrixXd rates = motorColumns(read, mechanism, "qdot", false);
  const Eigen::MatrixXd accelerations = motorColumns(read, mechanism, "qddot", false);
  MotorSamples out;
  out.t = read.at("t_s");
  out.mapped = found.mapped;
  out.has_derivatives = rates.size() > 0 && accelerations.size() > 0;
  if (!found.read_as.empty()) out.read_as = fmt::format("{}: read as: {}", shownPath(file.string()), found.read_as);
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
    out.quantum = std::max(out.quantum, half[&read.at(motorColumn(mechanism, k, "q")) - read.columns.data()]);
  requireDerivatives(read, mechanism, half);
  try {
    out.trajectory = makeMotorSamples(out.t, motorColumns(read, mechanism, "q", true), rates, accelerations);
    return out;
  } catch (const InvalidParameter& refusal) {
    throw CsvError(fmt::format("{}: error: {}: {}, expected {}", file.string(), refusal.place(), refusal.value(),
                               refusal.bound()));
  }
}

Eigen::MatrixXd motorColumns(const CsvTable& table, const Mechanism& mechanism, const char* of, bool required) {
  Eigen::MatrixXd out;
  const auto n = static_cast<Eigen::Index>(mechanism.motorCount());
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::string name = motorColumn(mechanism, k, of);
    if (k == 0 && !required && table.find(name) == nullptr) return out;
    const std::vector<double>* column = &table.at(name);
    if (k == 0) out.resize(static_cast<Eigen::Index>(column->size()), n);
    out.col(k) = Eigen::Map<const Eigen::VectorXd>(column->data(), static_cast<Eigen::Index>(column->size()));
  }
  return out;
}

std::string motorColumn(const Mechanism& mechanism, std::size_t k, const char* quantity) {
  const bool slides = mechanism.motor(k).slides();
  const std::string of = quantity;
  if (of == "tau") return fmt::format("tau_{}_{}", k + 1, mechanism.effortUnit(k));
  const char* power = of == "q" ? "" : of == "qdot" ? "_s" : "_s2";
  return fmt::format("{}_{}_{}{}", of, k + 1, slides ? "m" : "rad", power);
}

}  // namespace ursula
