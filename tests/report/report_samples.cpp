#include "tests/report/report_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "base/output_folder.h"
#include "model/scenario.h"

namespace ursula::test {
namespace {

constexpr int rows = 301;
constexpr double duration = 3.0;

template <class Function>
std::vector<double> sampled(const Function& function) {
  std::vector<double> values;
  values.reserve(rows);
  for (int i = 0; i < rows; ++i) values.push_back(function(duration * i / (rows - 1)));
  return values;
}

void addTorques(TimeSeries& series) {
  series.add("t_s", sampled([](double t) { return t; }));
  for (int leg = 1; leg <= 6; ++leg) {
    series.add("tau_" + std::to_string(leg) + "_Nm",
               sampled([leg](double t) { return 900 * std::cos(0.9 * t + leg) + 260 * leg - 40 * t * t; }));
  }
}

void addExpected(TimeSeries& series, double off) {
  for (int leg = 1; leg <= 6; ++leg) {
    std::vector<double> expected = *series.find("tau_" + std::to_string(leg) + "_Nm");
    for (double& value : expected) value /= 1 + (leg == 3 ? off : 1e-15);
    series.add("simbody_tau_" + std::to_string(leg) + "_Nm", expected);
  }
  series.add("limit_tau_Nm", sampled([](double t) { return 4e-10 * (1.1 + std::sin(t)); }));
}

void addMotion(TimeSeries& series) {
  const char* const axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const auto commanded = [i](double t) { return i == 2 ? 1.2 + 0.2 * t : 0.2 * std::sin(0.5 * t + i); };
    series.add(std::string("p_") + axes[i] + "_m", sampled(commanded));
    series.add(std::string("sim_p_") + axes[i] + "_m", sampled([commanded](double t) { return commanded(t) + 1e-9; }));
  }
  for (const std::string prefix : {"", "sim_"}) {
    series.add(prefix + "q_w", sampled([](double t) { return std::cos(0.05 * t); }));
    series.add(prefix + "q_x", sampled([](double t) { return std::sin(0.05 * t); }));
    for (const char* part : {"q_y", "q_z"}) series.add(prefix + part, std::vector<double>(rows, 0.0));
  }
  // An error that is nearly zero at the start, as in every replay, and then grows as in an unstable motion.
  const auto grown = [](double scale, double start) {
    return [scale, start](double t) { return t == 0 ? start : scale * std::exp(4.6 * t) * (1.2 + std::sin(9 * t)); };
  };
  series.add("error_p_m", sampled(grown(3e-15, 0)));
  series.add("error_q_rad", sampled(grown(9e-15, 6e-33)));
  series.add("closure_p_m", sampled([](double t) { return 2e-13 * (1.5 + std::sin(31 * t)); }));
  series.add("closure_v_m_s", sampled([](double t) { return 7e-12 * (1.5 + std::cos(23 * t)); }));
  series.add("reaction_1_x_N", sampled([](double t) { return t; }));
}

Curve workAgainstPrecision() {
  return {Curve::About::numerics,
          "Work against precision",
          "evaluations",
          false,
          {900, 1400, 2300, 4100, 7800, 15600},
          {{"rkf78_error_m", "", {2e-4, 5e-6, 9e-8, 6e-10, 3e-12, 4e-13}},
           {"rk_merson_error_m", "", {4e-3, 9e-4, 1e-4, 9e-6, 7e-7, 4e-8}}}};
}

Curve overTime(Curve::About about, const char* title) {
  return {about, title, "t", true, sampled([](double t) { return t; })};
}

Curve sources() {
  Curve curve = overTime(Curve::About::sources, "Sources of the replay's error");
  const auto add = [&curve](const char* label, double scale, CurveLine::Role role = CurveLine::Role::value) {
    curve.lines.push_back({label, "m", sampled([scale](double t) { return scale * std::exp(4.6 * t); }), role});
  };
  add("observed", 3e-15, CurveLine::Role::observed);
  add("rounding", 1e-15);
  add("integration", 2.4e-15);
  add("loop closure", 3e-16);
  add("torques", 5e-17);
  add("unexplained", 2e-16);
  add("limit", 4e-15, CurveLine::Role::limit);
  return curve;
}

Curve amplification() {
  Curve curve = overTime(Curve::About::numerics, "Amplification");
  curve.lines = {{"amplification", "", sampled([](double t) { return std::exp(4.6 * t); })}};
  return curve;
}

std::shared_ptr<const Scenario> shipped(const std::string& name) {
  return std::make_shared<const Scenario>(readScenario(std::string(URSULA_SCENARIOS) + "/" + name + ".toml"));
}

}  // namespace

ValidationResult passedSample() {
  ValidationResult result;
  result.scenario = "paper-helix";
  result.checks = {
      judged("torque.pointwise", 3.2e-12, 4.1e-10, "N·m", "64 eps · cond(K) 5.6e3 · largest torque 2306 N·m",
             "largest at leg 6, t = 0.31 s"),
      judged("inverse.roundtrip", 8.8e-14, 1.9e-11, "m/s²", "64 eps · cond(M) 310 · 9.81 m/s²", "platform, t = 2.94 s"),
      judged("replay.position", 2.9e-9, 3.6e-9, "m",
             "integration error 4.0e-15 m (order 7.9, from three tolerances) · amplification 9.0e5",
             "P is 2.9e-9 m off at t = 3 s; amplification explains 81 % of it"),
      judged("replay.orientation", 8.7e-9, 1.4e-8, "rad", "integration error 1.6e-14 rad · amplification 9.0e5",
             "at t = 3 s"),
      judged("closure.position", 5.0e-13, 1.0e-11, "m", "projection tolerance of the assembly", "leg 3, t = 1.02 s"),
      judged("closure.velocity", 1.7e-11, 1.0e-10, "m/s", "projection tolerance of the assembly", "leg 3, t = 0.55 s"),
      judged("energy.balance", 4.4e-7, 2.0e-5, "J", "trapezoid on 301 samples: h² / 12 · largest power' 2.4 kW/s",
             "work of the torques against kinetic and potential energy"),
      judged("solver.orthogonality", 0.0, 6.1e-15, "", "K·T = 0 to 64 eps with |K| = 1.9 and |T| = 2.2", "exactly 0"),
  };
  result.verdict = overall(result.checks);
  result.replay_error = ReplayError{};
  result.replay_error->dominant = ErrorSource::amplification;
  result.findings = {{"dominant error", "amplification"},
                     {"largest condition number of K", "5.6e3 at t = 1.88 s"},
                     {"integrator", "RKF78: 412 steps, 5 rejected, 5421 evaluations"}};
  result.subject = {"noc", Formulation::noc};
  result.provenance = {{"scenario sha256", "b1946ac92492d2347c6235b4d2611184f2c0a9e9c8a4f4bb1c2cb7d9b6e5f0aa"},
                       {"scenario file", "paper-helix.toml"},
                       {"subject", "noc"},
                       {"commit", "478470f"},
                       {"compiler", "GCC 12.2.0, -O3 -DNDEBUG"},
                       {"libraries", "Simbody 3.7, Eigen 3.4.0, Boost 1.74"},
                       {"integrator", "rkf78, tolerance 1e-14"},
                       {"seed", "20240611"}};
  addTorques(result.timeseries);
  addMotion(result.timeseries);
  addExpected(result.timeseries, 1e-15);
  result.curves = {sources(), workAgainstPrecision(), amplification()};
  result.events = {{1.88, "nearest to a singular pose"}};
  result.asked = shipped("paper-helix");
  return result;
}

ValidationResult failedSample() {
  ValidationResult result = passedSample();
  result.scenario = "torques of another solver";
  result.checks[0] =
      judged("torque.pointwise", 41.3, 4.1e-10, "N·m", result.checks[0].basis,
             "leg 2 is off by 41.3 N·m at t = 1.47 s; legs 1, 3–6 agree: look at leg 2's distal inertia");
  result.checks[2] =
      judged("replay.position", 6.2e-2, 3.6e-9, "m", result.checks[2].basis, "the model error explains all of it");
  result.checks.push_back(notMade("energy.balance_by_leg", "J", "the torques end at t = 2.1 s, the motion at t = 3 s"));
  result.verdict = overall(result.checks);
  result.timeseries = {};
  addTorques(result.timeseries);
  result.curves.clear();
  result.events.clear();
  result.asked = nullptr;
  return result;
}

ValidationResult inconclusiveSample() {
  ValidationResult result = passedSample();
  result.scenario = "near-singular";
  result.checks[3] = notJudgeable(Reason::limit_useless, "replay.orientation", 0.4, 2.7e3, "rad",
                                  "integration error · amplification 3.1e14",
                                  "amplification 3.1e14 leaves no digit of a double to judge by");
  result.verdict = overall(result.checks);
  return result;
}

ValidationResult externalSample() {
  ValidationResult result = passedSample();
  result.scenario = "leg-3-off";
  result.checks[0] = judged("torque.pointwise", 1.9, 4.1e-10, "N·m", result.checks[0].basis, "leg 3, t = 2.2 s");
  result.checks.push_back(notApplicable("torque.twin", "N·m", "a file gives torques alone, at its own instants"));
  result.verdict = overall(result.checks);
  result.findings.push_back({"torques that are off", "leg 3 by up to 1.9 N m; within their limits: 1, 2, 4, 5, 6"});
  result.findings.push_back({"likely cause", "a factor of 1.001 on leg 3"});
  result.cause_words = {"leg 3 by up to 1.9 N m; within their limits: 1, 2, 4, 5, 6", "a factor of 1.001 on leg 3"};
  result.subject = {"leg3.csv", Formulation::external, CalledBy::torques};
  for (std::size_t k = 0; k < result.timeseries.names.size(); ++k) {
    std::vector<double>& column = result.timeseries.columns[k];
    const std::string& name = result.timeseries.names[k];
    if (name == "tau_3_Nm")
      for (double& value : column) value *= 1.001;
    if (name.rfind("sim_", 0) == 0 || name.rfind("error_", 0) == 0)
      std::fill(column.begin() + rows / 2, column.end(), std::numeric_limits<double>::quiet_NaN());
  }
  result.events.push_back({1.5, "the replay left the path"});
  result.asked = shipped("three-legs");
  return result;
}

ValidationResult hostileSample() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const std::string text = "</script><script>alert('x')</script><!-- & \"quoted\" \x01\xff {{data}} ]]>";
  ValidationResult result;
  result.scenario = text;
  result.checks = {judged(text, nan, 1, text, text, text), judged("infinite", infinite, 1, "m", text, "why"),
                   judged("limit", 1, infinite, "m", text, "why"),
                   notJudgeable(Reason::limit_useless, text, nan, nan, text, text, text)};
  result.verdict = overall(result.checks);
  result.findings = {{text, text}};
  result.provenance = {{text, text}};
  result.timeseries.add("t_s", {0, 1, 2});
  result.timeseries.add("tau_1_Nm", {nan, 1, -infinite});
  result.timeseries.add("error_p_m", {0, 0, 0});
  result.curves = {{Curve::About::numerics, text, text, false, {3, nan, 1}, {{text + " y", "", {1, 2, infinite}}}}};
  return result;
}

void writeSuiteIndex(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir) {
  OutputFolder out(dir);
  addSuiteIndex(entries, out);
  out.commit();
}

}  // namespace ursula::test
