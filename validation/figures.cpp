#include "validation/figures.h"

#include <fmt/format.h>

#include "validation/picture.h"
#include "validation/validate.h"

namespace ursula {
namespace {

void addTrack(const std::string& name, const Picture::Track& track, const Vector3d& origin, TimeSeries& series) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> column;
    column.reserve(track.size());
    for (const Vector3d& point : track) column.push_back(point(axis) + origin(axis));
    series.add(fmt::format("{}_{}_m", name, "xyz"[axis]), std::move(column));
  }
}

}  // namespace

TimeSeries poseSeries(const Scenario& scenario, int count) {
  const std::vector<double> instants = equallySpaced(scenario.trajectory->duration(), count);
  const auto picture = makePicture(scenario, instants);
  TimeSeries series;
  series.add("t_s", instants);
  addTrack("p", picture->p, picture->origin, series);
  for (std::size_t i = 0; i < picture->legs.size(); ++i) {
    const std::vector<Picture::Link>& links = picture->legs[i].links;
    addTrack(fmt::format("A_{}", i + 1), links.front().from, picture->origin, series);
    addTrack(fmt::format("R_{}", i + 1), links.front().to, picture->origin, series);
    addTrack(fmt::format("B_{}", i + 1), links.back().to, picture->origin, series);
  }
  return series;
}

}  // namespace ursula
