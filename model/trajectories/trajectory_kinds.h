#pragma once

#include <array>
#include <memory>
#include <vector>

#include "model/scenario_keys.h"
#include "model/toml_reader.h"
#include "model/trajectory.h"

namespace ursula {

/// A kind of motion that a scenario may ask for. Its file here has its kernel, its keys and what reads them.
struct TrajectoryKind {
  const char* name;         ///< of `kind`
  const char* words;        ///< "the helix"
  const char* orientation;  ///< the key that has its first quaternion; null where none has
  std::vector<ScenarioTable> (*keys)();
  std::shared_ptr<const Trajectory> (*read)(const TomlSection& table);
};

// Each kind's file defines its own. What reads throws ScenarioError, InvalidParameter and CsvError.
std::vector<ScenarioTable> helixKeys(), waypointsKeys(), samplesKeys(), holdKeys();
std::shared_ptr<const Trajectory> readHelix(const TomlSection&table), readWaypoints(const TomlSection&table),
    readSamples(const TomlSection&table), readHold(const TomlSection&table);

/// The table of them all. Another kind is a file here and its row.
inline constexpr std::array trajectory_kinds = {
    TrajectoryKind{"helix", "the helix", nullptr, helixKeys, readHelix},
    TrajectoryKind{"waypoints", "the motion through waypoints", "trajectory.points[1].orientation", waypointsKeys,
                   readWaypoints},
    TrajectoryKind{"samples", "the motion through samples", "trajectory.file", samplesKeys, readSamples},
    TrajectoryKind{"hold", "its hold", "trajectory.orientation", holdKeys, readHold},
};

/// Null for a trajectory that a program made for itself.
const TrajectoryKind* trajectoryKind(const std::string& name);

/// [trajectory] and its kinds, for scenarioTables().
std::vector<ScenarioTable> motionTables();

// --- what the kinds' files share ---

/// `kind`, one of the names above.
ScenarioKey kindKey();
ScenarioKey positionKey();
/// `orientation`, a quaternion, and `rpy_deg` instead of it; readOrientation() takes either.
std::array<ScenarioKey, 2> orientationKeys();
Eigen::Vector4d readOrientation(const TomlSection& table);

}  // namespace ursula
