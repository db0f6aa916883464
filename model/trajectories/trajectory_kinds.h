#pragma once

#include <array>
#include <memory>
#include <vector>

#include "model/scenario_keys.h"
#include "model/toml_reader.h"
#include "model/trajectory.h"

namespace ursula {

/// A kind of motion in a scenario. Its file in this folder has its kernel, its keys and their reader.
struct TrajectoryKind {
  const char* name;         ///< value of `kind`
  const char* words;        ///< "the helix"
  const char* orientation;  ///< the dotted key of its first quaternion; null if there is none
  std::vector<ScenarioTable> (*keys)();
  std::shared_ptr<const Trajectory> (*read)(const TomlSection& table);
};

// Each kind's file defines its own functions. The readers throw ScenarioError, InvalidParameter and CsvError.
std::vector<ScenarioTable> helixKeys(), waypointsKeys(), samplesKeys(), holdKeys();
std::shared_ptr<const Trajectory> readHelix(const TomlSection&table), readWaypoints(const TomlSection&table),
    readSamples(const TomlSection&table), readHold(const TomlSection&table);

/// All kinds. A new kind needs a file here and a row.
inline constexpr std::array trajectory_kinds = {
    TrajectoryKind{"helix", "the helix", nullptr, helixKeys, readHelix},
    TrajectoryKind{"waypoints", "the motion through waypoints", "trajectory.points[1].orientation", waypointsKeys,
                   readWaypoints},
    TrajectoryKind{"samples", "the motion through samples", "trajectory.file", samplesKeys, readSamples},
    TrajectoryKind{"hold", "its hold", "trajectory.orientation", holdKeys, readHold},
};

/// Returns null for a trajectory that a program defined.
const TrajectoryKind* trajectoryKind(const std::string& name);

/// Returns [trajectory] and the tables of its kinds, for scenarioTables().
std::vector<ScenarioTable> motionTables();

// --- common parts of the kinds' files ---

/// Returns the key `kind`, with the names above as choices.
ScenarioKey kindKey();
ScenarioKey positionKey();
/// Returns the keys `orientation`, a quaternion, and `rpy_deg`, its alternative; readOrientation() reads either.
std::array<ScenarioKey, 2> orientationKeys();
Eigen::Vector4d readOrientation(const TomlSection& table);

}  // namespace ursula
