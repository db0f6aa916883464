#include "report/page/page_data.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "report/page/sections.h"
#include "report/page/singular.h"
#include "report/page/tracks.h"

namespace ursula::report {
namespace {

using Json = nlohmann::ordered_json;

/// Stores points that links and joints share only once.
class TrackTable {
 public:
  std::size_t add(const Picture::Track& points) {
    Json numbers = track(points);
    const auto at = std::find(tracks_.begin(), tracks_.end(), numbers);
    const std::size_t index = at - tracks_.begin();
    if (at == tracks_.end()) tracks_.push_back(std::move(numbers));
    return index;
  }
  const Json& json() const { return tracks_; }

 private:
  Json tracks_ = Json::array();
};

Json linksJson(const std::vector<Picture::Link>& links, TrackTable& table) {
  Json out = Json::array();
  for (const Picture::Link& link : links) {
    const std::size_t from = table.add(link.from);
    out.push_back({{"from", from}, {"to", table.add(link.to)}});
  }
  return out;
}

Json legJson(const Picture::Leg& leg, TrackTable& table) {
  Json out = {{"kind", leg.kind}, {"links", linksJson(leg.links, table)}, {"joints", Json::array()}};
  for (const Picture::Joint& joint : leg.joints) {
    Json axes = Json::array();
    const std::size_t at = table.add(joint.at);
    for (const Picture::Track& axis : joint.axes) axes.push_back(table.add(axis));
    out["joints"].push_back(
        {{"name", joint.name}, {"at", at}, {"driven", joint.driven}, {"slides", joint.slides}, {"axes", axes}});
  }
  out["rails"] = linksJson(leg.rails, table);
  return out;
}

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
Json forces(const AtInstants& at, const char* name, std::size_t legs) {
  std::vector<std::string> columns;
  for (std::size_t leg = 1; leg <= legs; ++leg)
    for (const char axis : {'x', 'y', 'z'}) columns.push_back(fmt::format("reaction_{}_{}_{}_N", name, axis, leg));
  return track(at.vectors(columns));
}

/// The platform motion with the least resistance, the leg that moves B least, and the lost direction; null if unknown.
Json weakJson(const Picture& picture) {
  const std::optional<std::vector<WeakDirections>> weak = weakDirections(picture);
  if (!weak) return nullptr;
  std::vector<Eigen::VectorXd> yielding, lost;
  Json legs = Json::array();
  for (const WeakDirections& each : *weak) {
    yielding.emplace_back(each.yielding);
    lost.emplace_back(each.lost);
    legs.push_back(each.leg);
  }
  return {{"yielding", track(yielding)}, {"lost", track(lost)}, {"leg", legs}};
}

}  // namespace

nlohmann::ordered_json machineJson(const Picture& picture, const ValidationResult& result) {
  Json wrong = Json::array();  // legs, 0-based
  for (const int motor : markedOf(motorsOff(result))) wrong.push_back(legOf(result, motor));
  const AtInstants at(result.timeseries, picture.t);
  std::vector<std::string> efforts;
  for (const Indexed& effort : indexed(result.timeseries, "tau"))
    efforts.push_back(fmt::format("tau_{}_{}", effort.index, effort.unit));
  TrackTable table;
  Json legs = Json::array();
  for (const Picture::Leg& leg : picture.legs) legs.push_back(legJson(leg, table));
  return {{"t", screenNumbers(picture.t)},
          {"tracks", table.json()},
          {"legs", legs},
          {"p", track(picture.p)},
          {"q", track(picture.q)},
          {"hold", track(picture.platform_points)},
          {"error", track(poseErrors(at))},
          {"efforts", track(at.vectors(efforts))},
          {"onPlatform", forces(at, "fB", picture.legs.size())},
          {"onBase", forces(at, "fA", picture.legs.size())},
          {"weak", weakJson(picture)},
          {"wrong", wrong}};
}

}  // namespace ursula::report
