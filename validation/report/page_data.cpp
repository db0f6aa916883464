#include "validation/report/page_data.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "validation/picture/picture.h"
#include "validation/report/quantity.h"

namespace ursula::report {
namespace {

constexpr std::size_t buckets = 500;

/// Six digits are more than a screen shows.
void addNumber(double value, std::string& out) {
  if (std::isfinite(value))
    fmt::format_to(std::back_inserter(out), "{:.6g}", value);
  else
    out += "null";
}

template <class Items, class Add>
std::string list(const Items& items, const Add& add) {
  std::string out = "[";
  for (const auto& item : items) {
    if (out.size() > 1) out += ',';
    add(item, out);
  }
  return out += ']';
}

std::string numbers(const std::vector<double>& values) { return list(values, addNumber); }

// "<" never appears, so neither "</script" nor "<!--" can end or derail the block that holds it.
std::string text(const std::string& words) {
  std::string out;
  for (const char c : nlohmann::json(words).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
    out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

const char* name(Stroke stroke) {
  return stroke == Stroke::limit ? "limit" : stroke == Stroke::ghost ? "ghost" : "line";
}

std::string lineJson(const Line& line) {
  return fmt::format(R"({{"label":{},"unit":{},"color":{},"stroke":"{}","values":{}}})", text(line.label),
                     text(line.unit), line.color, name(line.stroke), numbers(line.values));
}

std::string plotJson(const Plot& full) {
  const Plot plot = thinned(full, buckets);
  return fmt::format(
      R"({{"title":{},"xLabel":{},"yLabel":{},"logX":{},"logY":{},"overTime":{},"rows":{},"description":{},"x":{},"lines":{}}})",
      text(plot.title), text(plot.x_label), text(plot.y_label), plot.log_x, plot.log_y, plot.over_time, full.rows,
      text(full.title + ". " + inWords(full)), numbers(plot.x),
      list(plot.lines, [](const Line& line, std::string& out) { out += lineJson(line); }));
}

/// x, y, z of one instant after the other; of a point that never moves, once.
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

/// Points that links and joints share stand once.
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
    return list(tracks_, [](const std::string& each, std::string& out) { out += each; });
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
    out += fmt::format(R"({{"name":{},"at":{},"driven":{},"axes":{}}})", text(joint.name), table.add(joint.at),
                       joint.driven, list(joint.axes, add_axis));
  };
  return fmt::format(R"({{"kind":{},"links":{},"joints":{}}})", text(leg.kind), list(leg.links, add_link),
                     list(leg.joints, add_joint));
}

/// Columns of the time series at the picture's instants.
class AtInstants {
 public:
  AtInstants(const TimeSeries& series, const std::vector<double>& instants) : series_(series) {
    const std::vector<double>& t = *series.find("t_s");
    for (const double at : instants)
      rows_.push_back(static_cast<std::size_t>(std::lower_bound(t.begin(), t.end() - 1, at) - t.begin()));
  }

  /// Empty where a column is not there.
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

/// What the simulated pose is off by: [δp; rotation vector] at each instant.
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

/// Forces on the platform and at the base, of all legs one after the other.
std::string forces(const AtInstants& at, const char* name, std::size_t legs) {
  std::vector<std::string> columns;
  for (std::size_t leg = 1; leg <= legs; ++leg)
    for (const char axis : {'x', 'y', 'z'}) columns.push_back(fmt::format("reaction_{}_{}_{}_N", name, axis, leg));
  return track(at.vectors(columns));
}

std::string machineJson(const Picture& picture, const TimeSeries& series) {
  const AtInstants at(series, picture.t);
  std::vector<std::string> efforts;
  for (const Indexed& effort : indexed(series, "tau"))
    efforts.push_back(fmt::format("tau_{}_{}", effort.index, effort.unit));
  TrackTable table;
  const auto add_leg = [&table](const Picture::Leg& leg, std::string& out) { out += legJson(leg, table); };
  const std::string legs = list(picture.legs, add_leg);
  return fmt::format(
      R"({{"t":{},"tracks":{},"legs":{},"p":{},"q":{},"hold":{},"error":{},"efforts":{},"onPlatform":{},"onBase":{}}})",
      numbers(picture.t), table.json(), legs, track(picture.p), track(picture.q), track(picture.platform_points),
      track(poseErrors(at)), track(at.vectors(efforts)), forces(at, "fB", picture.legs.size()),
      forces(at, "fA", picture.legs.size()));
}

/// Those of the result, and where the checks that matter most were worst.
std::string eventsJson(const ValidationResult& result) {
  std::vector<Event> events = result.events;
  for (const Check& check : result.checks)
    if ((check.name == "torque.pointwise" || check.name == "replay.position") && std::isfinite(check.largest.value) &&
        check.largest.value > 0)
      events.push_back(
          {check.largest.t, (check.name[0] == 't' ? "largest effort deviation, " : "largest replay error, ") +
                                quantity(check.largest.value, check.unit)});
  return list(events, [](const Event& event, std::string& out) {
    out += R"({"t":)";
    addNumber(event.t, out);
    out += R"(,"what":)" + text(event.what) + "}";
  });
}

}  // namespace

std::string pageData(const ValidationResult& result, const std::vector<Plot>& plots) {
  const bool has_machine = result.picture != nullptr && result.timeseries.find("t_s") != nullptr;
  return fmt::format(R"({{"scenario":{},"events":{},"machine":{},"plots":{}}})", text(result.scenario),
                     eventsJson(result), has_machine ? machineJson(*result.picture, result.timeseries) : "null",
                     list(plots, [](const Plot& plot, std::string& out) { out += plotJson(plot); }));
}

}  // namespace ursula::report
