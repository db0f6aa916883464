#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/csv.h"
#include "model/mechanism.h"
#include "model/motor_trajectory.h"
#include "model/scenario.h"

namespace ursula {

/// What `[mechanism]` says beside its file; as the options of `import`.
struct MechanismChoices {
  std::vector<std::string> motors;  ///< names of joints; empty for those that the file drives
  std::vector<std::string> close;   ///< "A:B", two links whose frame origins a ball joins
  std::string base;                 ///< a body that stands still, or empty
  std::string key;                  ///< a keyframe whose pose is the initial one, or empty
  std::vector<std::string> leave_out;
  std::optional<Vector3d> gravity;
};

/// A mechanism as a model file describes it, and what was assumed on reading, in sentences.
struct ModelRead {
  MechanismParameters machine;
  std::vector<std::string> assumptions, warnings;
};
/// Reads a model file in SDF, MJCF or URDF. A part provides it. Throws InputError with the file's place, and
/// InvalidParameter (places `mechanism.…`) for choices that the file does not have.
using ModelReader = ModelRead (*)(const std::filesystem::path& file, const MechanismChoices& choices);
/// Null if no part of this build reads models. CMake writes the definition (cmake/parts.cmake), once for each program.
ModelReader partModelReader();

/// Returns the command that makes a scenario of a model file. Throws InputError if the file is no model.
using ModelAdvice = std::string (*)(const std::filesystem::path& file);
/// Null if no part of this build reads models.
ModelAdvice partModelAdvice();

/// A mechanism of any kind, the commanded motion of its motors, and how both are judged.
struct MechanismScenario {
  std::string name;
  std::filesystem::path file;  ///< of the scenario
  std::string text;            ///< the file as read; its hash is part of the provenance
  std::filesystem::path model;
  ModelRead read;
  std::shared_ptr<const Mechanism> mechanism;
  std::shared_ptr<const MotorTrajectory> trajectory;
  std::string motion_read_as;       ///< how the motion's file was read, with its name; empty if it is by the contract
  std::vector<std::string> mapped;  ///< entries of the user's map that named the columns of that file
  SimulationSettings simulation;
  std::vector<AcceptanceLimit> acceptance;
  std::optional<EffortTolerance> tolerance;
};

/// Returns whether a scenario's text has `[mechanism]`. A text that is no TOML has none.
bool isMechanism(const std::string& text);
/// Returns the same of a file. Throws ScenarioError if it cannot be read.
bool isMechanismFile(const std::filesystem::path& file);

/// Reads and checks a whole scenario with `[mechanism]`; `file` names it in errors and anchors relative paths. `map` is
/// for its motion's file, as for readMotorTable(). Throws ScenarioError, and what `reader` throws.
MechanismScenario parseMechanism(const std::string& text, const std::filesystem::path& file,
                                 ModelReader reader = partModelReader(), const std::vector<std::string>& map = {});
MechanismScenario readMechanism(const std::filesystem::path& file, ModelReader reader = partModelReader());

/// The motors' motion in a file, as `kind = "samples"` reads it, and its instants.
struct MotorSamples {
  std::vector<double> t;
  std::shared_ptr<const MotorTrajectory> trajectory;
  bool has_derivatives = false;  ///< whether the file gives rates and accelerations
  double quantum = 0;            ///< half a unit of the last digit of the coarsest coordinate, rad or m; 0 if unknown
  std::string read_as = {};      ///< "FILE: read as: …"; empty for a file by the contract
  std::vector<std::string> mapped = {};  ///< as in MotorTable
};
/// `map` is as for readMotorTable(). Throws CsvError.
MotorSamples readMotorSamples(const std::filesystem::path& file, const Mechanism& mechanism,
                              const std::vector<std::string>& map = {});

/// Returns the names of a motor's columns: "q_1_rad", "qdot_1_rad_s", "qddot_1_rad_s2", "tau_1_Nm", or with m and N.
std::string motorColumn(const Mechanism& mechanism, std::size_t k, const char* quantity);

/// Takes one quantity of all motors ("q", "qdot", "qddot") from a MotorTable's table, a row for each of its rows. Empty
/// if the first motor has none and it is not `required`; else throws CsvError.
Eigen::MatrixXd motorColumns(const CsvTable& table, const Mechanism& mechanism, const char* quantity, bool required);

}  // namespace ursula
