// What this part adds to a verdict.

#include "validation/likely_cause.h"

#include "parts/causes/diagnosis.h"
#include "parts/causes/places.h"

namespace ursula {

AddLikelyCause addLikelyCause;

void addLikelyCause(const Scenario& scenario, const TorqueFile& efforts, const WrongSolver* solver,
                    ValidationResult& result) {
  const ExternalTorques torques = runExternal(scenario, efforts);
  if (solver == nullptr) return addDiagnosis(diagnose(scenario, torques), result);
  const Evidence& evidence = solver->evidence;
  std::vector<Motion<double>> motions;
  for (const double t : efforts.t) motions.push_back(scenario.trajectory->at(t));
  AskedApart asked;
  asked.no_cause = solver->no_cause;
  if (evidence.has.out_of_time.empty() && asked.no_cause.empty()) asked = askedApart(solver->in_si, scenario, motions);
  Diagnosis found = diagnose(scenario, torques, asked);
  const Places places = placesOf(*evidence.scenario, evidence.samples, solver->natural.answers());
  if (!places.areAlike()) sayPlaces(places, *scenario.manipulator, evidence.natural, found);
  addDiagnosis(found, result);
}

}  // namespace ursula
