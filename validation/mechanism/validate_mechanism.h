#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "model/mechanism_picture.h"
#include "validation/mechanism/mechanism_evidence.h"
#include "validation/verdict/result.h"

namespace ursula {

struct MechanismOptions {
  double time_limit = 0;  ///< s; 0: none
  std::function<bool()> asked_to_end = nullptr;
  std::function<void(double share, const char* now)> progress = nullptr;
  bool thorough = false;  ///< a solver is asked at every sample, and at more instants between them
  bool quick = false;     ///< only what the samples show
};

/// Validates a mechanism of any kind: as validate() does a manipulator, by the same catalogue of checks. Throws
/// LoopError where the loops cannot follow the motion, ScenarioError for a wrong number of motors.
ValidationResult validateMechanism(const MechanismScenario& read, const MechanismSubject& subject = {},
                                   const MechanismOptions& options = {});

/// The solver of a scenario along its motion, with as many motors as freedoms. Throws ScenarioError that names the
/// joints that are left free, or the motors that fight each other.
class MechanismAlong {
 public:
  explicit MechanismAlong(const MechanismScenario& scenario);
  /// Returns the scenario; where the file's pose is open, the mechanism has the start at which its loops are closed.
  const MechanismScenario& scenario() const { return scenario_; }
  const LoopMotion& motion() const { return *motion_; }
  const LoopSolver& solver() const { return *solver_; }
  const LoopFreedoms& freedoms() const { return freedoms_; }

 private:
  MechanismScenario scenario_;
  std::unique_ptr<LoopSolver> solver_;
  LoopFreedoms freedoms_;
  std::unique_ptr<LoopMotion> motion_;
};

/// Says by how much closing the file's pose moved a joint; empty where it is little.
std::string assemblyInWords(const LoopSolver& solver);

/// Returns the machine at so many equally spaced instants of its motion, at least two.
std::shared_ptr<const MechanismPicture> makePicture(const MechanismScenario& scenario, const MechanismAlong& along,
                                                    int instants);
/// Returns the machine as its model file places it; for one that has too few motors or cannot move.
std::shared_ptr<const MechanismPicture> pictureAsRead(const MechanismScenario& scenario);

/// Reads the columns that readTorqueColumns() finds. Throws CsvError, also for instants that do not increase or lie
/// outside of the motion.
GivenEfforts readMotorEfforts(const std::filesystem::path& file, const Mechanism& mechanism, double duration,
                              const std::vector<std::pair<std::string, std::string>>& map = {});

/// Returns the same of numbers in memory; they count as a file that gives each number by its shortest text.
GivenEfforts givenEfforts(const std::string& name, const std::vector<double>& t,
                          const std::vector<MotorEfforts>& efforts, const Mechanism& mechanism, double duration);

/// Engines of the parts in this build, beside Simbody.
std::vector<MakeMechanismEngine> partMechanismEngines();

/// Reads the scenario's model file with another reader, and compares: `model.reading`. A part does it; null if none.
using ReadModelAgain = Check(const MechanismScenario& scenario);
ReadModelAgain* partModelReading();

/// Names likely causes of wrong efforts; a part does it.
using AddMechanismCause = void(const MechanismScenario& scenario, const MechanismEvidence& evidence,
                               ValidationResult& result);
AddMechanismCause* partMechanismCause();

}  // namespace ursula
