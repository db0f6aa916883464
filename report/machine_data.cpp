#include "report/sections.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "report/picture.h"
#include "report/plots.h"
#include "report/singular.h"
#include "report/text.h"

namespace ursula::report {
namespace {

/// Writes x, y, z of all instants in order; a constant point is written once.
template <class Vectors>
std::string track(const Vectors& points) {
  const bool still = std::all_of(points.begin(), points.end(), [&](const auto& point) { return point == points[0]; });
  std::string out = "[";
  for (const auto& point : points) {
    for (Eigen::Index k = 0; k < point.size(); ++k) {
      if (out.size() > 1) out += ',';
      addNumber(point(k), out);
    }
    if (still) break;
  }
  return out += ']';
}

/// Stores points that links and joints share only once.
class TrackTable {
 public:
  std::size_t add(const Picture::Track& points) {
    const std::string json = track(points);
    const auto at = std::find(tracks_.begin(), tracks_.end(), json);
    if (at != tracks_.end()) return static_cast<std::size_t>(at - tracks_.begin());
    tracks_.push_back(json);
    return tracks_.size() - 1;
  }
  std::string json() const {
    return jsonList(tracks_, [](const std::string& each, std::string& out) { out += each; });
  }

 private:
  std::vector<std::string> tracks_;
};

std::string legJson(const Picture::Leg& leg, TrackTable& table) {
  const auto add_link = [&table](const Picture::Link& link, std::string& out) {
    out += fmt::format(R"({{"from":{},"to":{}}})", table.add(link.from), table.add(link.to));
  };
  const auto add_axis = [&table](const Picture::Track& axis, std::string& out) {
    out += std::to_string(table.add(axis));
  };
  const auto add_joint = [&](const Picture::Joint& joint, std::string& out) {
    out += fmt::format(R"({{"name":{},"at":{},"driven":{},"slides":{},"axes":{}}})", jsonText(joint.name),
                       table.add(joint.at), joint.driven, joint.slides, jsonList(joint.axes, add_axis));
  };
  return fmt::format(R"({{"kind":{},"links":{},"joints":{},"rails":{}}})", jsonText(leg.kind),
                     jsonList(leg.links, add_link), jsonList(leg.joints, add_joint), jsonList(leg.rails, add_link));
}

/// Columns of the time series at the picture's instants.
class AtInstants {
 public:
  AtInstants(const TimeSeries& series, const std::vector<double>& instants) : series_(series) {
    const std::vector<double>& t = *series.find("t_s");
    for (const double at : instants)
      rows_.push_back(static_cast<std::size_t>(std::lower_bound(t.begin(), t.end() - 1, at) - t.begin()));
  }

  /// Returns nothing if a column is missing.
  std::vector<Eigen::VectorXd> vectors(const std::vector<std::string>& columns) const {
    std::vector<Eigen::VectorXd> out(rows_.size(), Eigen::VectorXd(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::vector<double>* values = series_.find(columns[k]);
      if (values == nullptr) return {};
      for (std::size_t i = 0; i < rows_.size(); ++i) out[i](static_cast<Eigen::Index>(k)) = (*values)[rows_[i]];
    }
    return out;
  }

 private:
  const TimeSeries& series_;
  std::vector<std::size_t> rows_;
};

/// The error of the simulated pose at each instant: [δp; rotation vector].
std::vector<Eigen::VectorXd> poseErrors(const AtInstants& at) {
  const auto p = at.vectors({"p_x_m", "p_y_m", "p_z_m"}), sim_p = at.vectors({"sim_p_x_m", "sim_p_y_m", "sim_p_z_m"});
  const auto q = at.vectors({"q_w", "q_x", "q_y", "q_z"}),
             sim_q = at.vectors({"sim_q_w", "sim_q_x", "sim_q_y", "sim_q_z"});
  if (p.empty() || sim_p.empty() || q.empty() || sim_q.empty()) return {};
  std::vector<Eigen::VectorXd> out;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const auto quaternion = [k](const std::vector<Eigen::VectorXd>& rows) {
      return Eigen::Quaterniond(rows[k](0), rows[k](1), rows[k](2), rows[k](3));
    };
    const Eigen::Quaterniond turn = quaternion(sim_q) * quaternion(q).conjugate();
    Eigen::VectorXd error(6);
    error << sim_p[k] - p[k], 2 * std::copysign(1.0, turn.w()) * turn.vec();
    out.push_back(error);
  }
  return out;
}

/// Forces on the platform and at the base, leg after leg.
std::string forces(const AtInstants& at, const char* name, std::size_t legs) {
  std::vector<std::string> columns;
  for (std::size_t leg = 1; leg <= legs; ++leg)
    for (const char axis : {'x', 'y', 'z'}) columns.push_back(fmt::format("reaction_{}_{}_{}_N", name, axis, leg));
  return track(at.vectors(columns));
}

/// The platform motion with the least resistance, the leg that moves B least, and the lost direction; null if unknown.
std::string weakJson(const Picture& picture) {
  const std::optional<std::vector<WeakDirections>> weak = weakDirections(picture);
  if (!weak) return "null";
  std::vector<Eigen::VectorXd> yielding, lost;
  std::vector<double> legs;
  for (const WeakDirections& each : *weak) {
    yielding.emplace_back(each.yielding);
    lost.emplace_back(each.lost);
    legs.push_back(static_cast<double>(each.leg));
  }
  return fmt::format(R"({{"yielding":{},"lost":{},"leg":{}}})", track(yielding), track(lost), jsonNumbers(legs));
}

}  // namespace

std::string machineJson(const Picture& picture, const ValidationResult& result) {
  const TimeSeries& series = result.timeseries;
  std::vector<double> wrong;  // legs, 0-based
  for (const MotorDeviation& motor : motorsOff(result))
    if (!motor.right) wrong.push_back(motorsOf(result)[static_cast<std::size_t>(motor.motor)].leg);
  const AtInstants at(series, picture.t);
  std::vector<std::string> efforts;
  for (const Indexed& effort : indexed(series, "tau"))
    efforts.push_back(fmt::format("tau_{}_{}", effort.index, effort.unit));
  TrackTable table;
  const auto add_leg = [&table](const Picture::Leg& leg, std::string& out) { out += legJson(leg, table); };
  const std::string legs = jsonList(picture.legs, add_leg);
  return fmt::format(
      R"({{"t":{},"tracks":{},"legs":{},"p":{},"q":{},"hold":{},"error":{},"efforts":{},"onPlatform":{},"onBase":{},"weak":{},"wrong":{}}})",
      jsonNumbers(picture.t), table.json(), legs, track(picture.p), track(picture.q), track(picture.platform_points),
      track(poseErrors(at)), track(at.vectors(efforts)), forces(at, "fB", picture.legs.size()),
      forces(at, "fA", picture.legs.size()), weakJson(picture), jsonNumbers(wrong));
}

}  // namespace ursula::report
