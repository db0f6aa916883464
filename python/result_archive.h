#pragma once

#include <ursula/validate.h>

#include <filesystem>
#include <memory>
#include <string>

#include "python/archive.h"

namespace ursula::python {

/// Traverses a struct. Every member is named, so that a new one causes a compiler error here.
#define URSULA_MEMBERS(Type, ...)                      \
  inline void members(Archive& archive, Type& whole) { \
    auto& [__VA_ARGS__] = whole;                       \
    archive(__VA_ARGS__);                              \
  }

URSULA_MEMBERS(Largest, value, t, where)
URSULA_MEMBERS(Check, name, value, limit, unit, verdict, basis, why, reason, largest, limit_by, missed, gap, off)
URSULA_MEMBERS(TimeSeries, names, columns)
URSULA_MEMBERS(CurveLine, label, unit, values, role)
URSULA_MEMBERS(Curve, about, title, x_label, over_time, x, lines)
URSULA_MEMBERS(Event, t, what)
URSULA_MEMBERS(EffortDeviation, unit, largest, t, where, largest_effort, drift, duration, length, seen, seen_for,
               allowed, without, from_without)
URSULA_MEMBERS(Voice, engine, formulations)
URSULA_MEMBERS(OddOne, formulations, agree, odd)
URSULA_MEMBERS(NamedCause, kind, term, body, parameter, unit, expected, found, uncertainty, leg, motor, legs, from, to,
               explained, joint, signs)
URSULA_MEMBERS(ScenarioChange, key, value)
URSULA_MEMBERS(FailureSize, grade, limits, rounding, least_term, least_share, remedy)
URSULA_MEMBERS(NeededRows, rows, given)
URSULA_MEMBERS(BlindSpot, mistake, alike, cause, largest)
URSULA_MEMBERS(TermError, term, error)
URSULA_MEMBERS(CauseWords, off, cause, claim)
URSULA_MEMBERS(Finding, name, words, value, uncertainty, unit, t, leg)
URSULA_MEMBERS(JudgedSubject, name, formulation, called_by, map, torques)

/// It is parsed again from its text.
inline void members(Archive& archive, std::shared_ptr<const Scenario>& asked) {
  bool has = asked != nullptr;
  archive(has);
  if (!has) return;
  std::string text, file;
  std::optional<EffortTolerance> tolerance;
  if (!archive.reads()) {
    text = asked->text;
    file = std::filesystem::absolute(asked->file).string();
    tolerance = asked->tolerance;
  }
  archive(text, file, tolerance);
  if (!archive.reads()) return;
  Scenario scenario = parseScenario(text, file);
  scenario.tolerance = tolerance;
  asked = std::make_shared<const Scenario>(std::move(scenario));
}

inline void members(Archive& archive, ValidationResult& result) {
  auto& [scenario, kind, subject, limits, verdict, checks, provenance, run, findings, odd_one, replay_error, cause,
         causes, together, size, needed, terms, blind, words, windows, deviation, effort, timeseries, curves, events,
         asked, mechanism] = result;
  static_cast<void>(mechanism);  // a picture, which a result that was read does without
  archive(scenario, kind, subject, limits, verdict, checks, provenance, run, findings, odd_one, replay_error, cause,
          causes, together, size, needed, terms, blind, words, windows, deviation, effort, timeseries, curves, events,
          asked);
}

}  // namespace ursula::python
