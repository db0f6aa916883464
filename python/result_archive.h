#pragma once

#include <ursula/validate.h>

#include <filesystem>
#include <memory>
#include <string>

#include "python/archive.h"

namespace ursula::python {

// Every member is named, so that a new one causes a compiler error here.

inline void members(Archive& archive, Largest& largest) {
  auto& [value, t, where] = largest;
  archive(value, t, where);
}

inline void members(Archive& archive, Check& check) {
  auto& [name, value, limit, unit, verdict, basis, why, reason, largest, limit_by, missed, gap, off] = check;
  archive(name, value, limit, unit, verdict, basis, why, reason, largest, limit_by, missed, gap, off);
}

inline void members(Archive& archive, TimeSeries& series) {
  auto& [names, columns] = series;
  archive(names, columns);
}

inline void members(Archive& archive, CurveLine& line) {
  auto& [label, unit, values, role] = line;
  archive(label, unit, values, role);
}

inline void members(Archive& archive, Curve& curve) {
  auto& [about, title, x_label, over_time, x, lines] = curve;
  archive(about, title, x_label, over_time, x, lines);
}

inline void members(Archive& archive, Event& event) {
  auto& [t, what] = event;
  archive(t, what);
}

inline void members(Archive& archive, EffortDeviation& deviation) {
  auto& [unit, largest, t, where, largest_effort, drift, duration, length, seen, seen_for, allowed, without,
         from_without] = deviation;
  archive(unit, largest, t, where, largest_effort, drift, duration, length, seen, seen_for, allowed, without,
          from_without);
}

inline void members(Archive& archive, Voice& voice) {
  auto& [engine, formulations] = voice;
  archive(engine, formulations);
}

inline void members(Archive& archive, OddOne& odd_one) {
  auto& [formulations, agree, odd] = odd_one;
  archive(formulations, agree, odd);
}

inline void members(Archive& archive, NamedCause& cause) {
  auto& [kind, term, body, parameter, unit, expected, found, uncertainty, leg, motor, legs, from, to, explained, joint,
         signs] = cause;
  archive(kind, term, body, parameter, unit, expected, found, uncertainty, leg, motor, legs, from, to, explained, joint,
          signs);
}

inline void members(Archive& archive, ScenarioChange& change) {
  auto& [key, value] = change;
  archive(key, value);
}

inline void members(Archive& archive, FailureSize& size) {
  auto& [grade, limits, rounding, least_term, least_share, remedy] = size;
  archive(grade, limits, rounding, least_term, least_share, remedy);
}

inline void members(Archive& archive, NeededRows& needed) {
  auto& [rows, given] = needed;
  archive(rows, given);
}

inline void members(Archive& archive, BlindSpot& spot) {
  auto& [mistake, alike, cause, largest] = spot;
  archive(mistake, alike, cause, largest);
}

inline void members(Archive& archive, TermError& each) {
  auto& [term, error] = each;
  archive(term, error);
}

inline void members(Archive& archive, CauseWords& words) {
  auto& [off, cause, claim] = words;
  archive(off, cause, claim);
}

inline void members(Archive& archive, Finding& finding) {
  auto& [name, words, value, uncertainty, unit, t, leg] = finding;
  archive(name, words, value, uncertainty, unit, t, leg);
}

inline void members(Archive& archive, JudgedSubject& subject) {
  auto& [name, formulation, called_by, map, torques] = subject;
  archive(name, formulation, called_by, map, torques);
}

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
