#include <fmt/format.h>
#include <algorithm>
#include <tuple>

#include "report/page/html_template.h"
#include "report/page/plots.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {

extern const std::string_view chart_html;  // of web/

namespace {

std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b, bool size) {
  std::vector<double> out;
  out.reserve(a.size());
  for (std::size_t k = 0; k < a.size() && k < b.size(); ++k) out.push_back(size ? std::abs(a[k] - b[k]) : a[k] - b[k]);
  return out;
}

/// Returns the label of an axis that all efforts share: "effort (N·m)", "effort (N·m, N)".
std::string effortLabel(const char* what, const std::vector<Indexed>& efforts) {
  std::vector<std::string> units;
  for (const Indexed& each : efforts)
    if (std::find(units.begin(), units.end(), each.unit) == units.end()) units.push_back(each.unit);
  std::string text;
  for (const std::string& unit : units) text += (text.empty() ? "" : ", ") + prettyUnit(unit);
  return fmt::format("{} ({})", what, text);
}

/// The column of the motor's own limit, such as "limit_tau_2_N", or else of all in the unit that they share.
std::string limitColumn(const TimeSeries& series, const std::string& motor) {
  if (const std::string own = "limit_tau_" + motor; series.find(own) != nullptr) return own;
  return series.find("limit_tau_N") == nullptr ? "limit_tau_Nm" : "limit_tau_N";
}

/// Adds the decisive limit: the derived one, or a user's tolerance.
void addEffortLimit(TimePlots& time, Plot& plot, const Indexed& motor, double allowed, double side) {
  const std::string label = std::string(side < 0 ? "− " : "") + (allowed > 0 ? "your tolerance" : "limit");
  const Line line = {label, prettyUnit(motor.unit), 0, Stroke::limit, {}};
  if (allowed > 0)
    time.addValues(plot, std::vector<double>(time.series().rows(), side * allowed), line);
  else
    time.addColumn(plot, limitColumn(time.series(), motor.index + "_" + motor.unit), line, side);
}

void addErrors(TimePlots& time, double allowed) {
  const TimeSeries& series = time.series();
  const std::vector<Indexed> efforts = indexed(series, "tau"), expected = indexed(series, "simbody_tau");
  if (!expected.empty() && efforts.size() == expected.size()) {
    Plot deviation =
        time.plot(PlotGroup::errors, "Efforts against Simbody's, each motor", effortLabel("deviation", efforts), true);
    for (std::size_t k = 0; k < efforts.size(); ++k)
      time.addValues(
          deviation, differences(*efforts[k].values, *expected[k].values, true),
          {time.label("τ", efforts[k].index), prettyUnit(efforts[k].unit), static_cast<int>(k), Stroke::line, {}});
    if (allowed > 0 || indexed(series, "limit_tau").empty()) addEffortLimit(time, deviation, {}, allowed, 1);
    time.keep(std::move(deviation));
  }
  Plot acceleration = time.plot(PlotGroup::errors, "Simbody's acceleration under the efforts", "error (m/s²)", true);
  time.addColumn(acceleration, "error_acceleration_m_s2", {"platform", "m/s²", 0, Stroke::line, {}});
  const char* const limit = allowed > 0 ? "derived limit, not judged" : "limit";
  time.addColumn(acceleration, "limit_acceleration_m_s2", {limit, "", 0, Stroke::limit, {}});
  time.keep(std::move(acceleration));
  Plot replay = time.plot(PlotGroup::errors, "Replay: simulated against commanded pose", "error (m, rad)", true);
  time.addColumn(replay, "error_p_m", {"position", "m", 0, Stroke::line, {}});
  time.addColumn(replay, "error_q_rad", {"orientation", "rad", 1, Stroke::line, {}});
  time.keep(std::move(replay));
  Plot closure = time.plot(PlotGroup::errors, "Closure of the loops", "gap (m, m/s)", true);
  time.addColumn(closure, "closure_p_m", {"position", "m", 0, Stroke::line, {}});
  time.addColumn(closure, "closure_v_m_s", {"velocity", "m/s", 1, Stroke::line, {}});
  time.keep(std::move(closure));
  Plot energy = time.plot(PlotGroup::errors, "Energy less work", "energy (J)");
  time.addColumn(energy, "error_energy_J", {"E − E₀ − work", "J", 0, Stroke::line, {}});
  time.keep(std::move(energy));
}

/// The rates of driven coordinates; empty if one is missing.
std::vector<const std::vector<double>*> drivenRates(const TimeSeries& series, const Motors& motors) {
  std::vector<const std::vector<double>*> out;
  for (const Indexed& rate : indexed(series, "qdot")) out.push_back(rate.values);
  if (!out.empty()) return out;
  for (const Motor& motor : motors)
    out.push_back(series.find(
        fmt::format("{}dot_{}_{}", nameOf(motor.coordinate), motor.leg + 1, motor.slides() ? "m_s" : "rad_s")));
  if (std::find(out.begin(), out.end(), nullptr) != out.end()) out.clear();
  return out;
}

/// The motors' power: effort times the rate of the driven coordinate.
void addPower(TimePlots& time, const std::vector<Indexed>& efforts, const Motors& motors) {
  const std::vector<const std::vector<double>*> rates = drivenRates(time.series(), motors);
  if (rates.empty() || rates.size() != efforts.size()) return;
  Plot power = time.plot(PlotGroup::efforts, "Power of the motors", "power (W)");
  std::vector<double> sum(rates[0]->size(), 0.0);
  for (std::size_t k = 0; k < efforts.size(); ++k) {
    std::vector<double> product;
    for (std::size_t row = 0; row < sum.size(); ++row) {
      product.push_back((*efforts[k].values)[row] * (*rates[k])[row]);
      sum[row] += product.back();
    }
    time.addValues(power, product, {time.label("P", efforts[k].index), "W", static_cast<int>(k), Stroke::line, {}});
  }
  time.addValues(power, sum, {"all", "W", 6, Stroke::ghost, {}});
  time.keep(std::move(power));
}

void addEfforts(TimePlots& time, const Motors& motors, double allowed, int worst) {
  const TimeSeries& series = time.series();
  const std::vector<Indexed> efforts = indexed(series, "tau"), expected = indexed(series, "simbody_tau");
  Plot all = time.plot(PlotGroup::efforts, "Efforts of the motors", effortLabel("effort", efforts));
  time.addIndexed(all, "simbody_tau", "τ", true);
  time.addIndexed(all, "tau", "τ");
  time.keep(std::move(all));
  addPower(time, efforts, motors);
  if (efforts.size() != expected.size()) return;
  for (std::size_t k = 0; k < efforts.size(); ++k) {
    const std::string unit = prettyUnit(efforts[k].unit);
    const bool is_worst = static_cast<int>(k) == worst;
    if (is_worst) {
      Plot both = time.plot(PlotGroup::worst, time.motor(efforts[k].index) + ": given and expected effort",
                            fmt::format("effort ({})", unit));
      time.addValues(both, *expected[k].values, {"expected", unit, static_cast<int>(k), Stroke::ghost, {}});
      time.addValues(both, *efforts[k].values, {"given", unit, static_cast<int>(k), Stroke::line, {}});
      time.keep(std::move(both));
    }
    Plot motor =
        time.plot(is_worst ? PlotGroup::worst : PlotGroup::efforts,
                  time.motor(efforts[k].index) + ": effort less expected", fmt::format("deviation ({})", unit));
    time.addValues(motor, differences(*efforts[k].values, *expected[k].values, false),
                   {time.label("τ", efforts[k].index) + " − expected", unit, static_cast<int>(k), Stroke::line, {}});
    for (const double side : {1.0, -1.0}) addEffortLimit(time, motor, efforts[k], allowed, side);
    time.keep(std::move(motor));
  }
}

void addMotion(TimePlots& time) {
  Plot position = time.plot(PlotGroup::motion, "Position of P", "position (m)");
  const char* const axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const std::string axis = axes[i];
    time.addColumn(position, "p_" + axis + "_m", {axis + " commanded", "m", i, Stroke::ghost, {}});
    time.addColumn(position, "sim_p_" + axis + "_m", {axis + " simulated", "m", i, Stroke::line, {}});
  }
  time.keep(std::move(position));
  Plot turned = time.plot(PlotGroup::motion, "Orientation of the platform", "quaternion (1)");
  const char* const parts[] = {"w", "x", "y", "z"};
  for (int i = 0; i < 4; ++i) {
    const std::string part = parts[i];
    time.addColumn(turned, "q_" + part, {part + " commanded", "", i, Stroke::ghost, {}});
    time.addColumn(turned, "sim_q_" + part, {part + " simulated", "", i, Stroke::line, {}});
  }
  time.keep(std::move(turned));
  struct Joint {
    const char *column, *title, *symbol;
  };
  const Joint joints[] = {{"phi", "Joint angles φ", "φ"},     {"psi", "Joint angles ψ", "ψ"},
                          {"theta", "Joint angles θ", "θ"},   {"d", "Joint displacements d", "d"},
                          {"phidot", "Joint rates φ̇", "φ̇"},   {"psidot", "Joint rates ψ̇", "ψ̇"},
                          {"thetadot", "Joint rates θ̇", "θ̇"}, {"ddot", "Joint rates ḋ", "ḋ"}};
  for (const Joint& joint : joints) {
    const std::vector<Indexed> columns = indexed(time.series(), joint.column);
    if (columns.empty()) continue;
    Plot plot =
        time.plot(PlotGroup::motion, joint.title, fmt::format("{} ({})", joint.symbol, prettyUnit(columns[0].unit)));
    time.addIndexed(plot, joint.column, joint.symbol);
    time.keep(std::move(plot));
  }
}

/// The motors' coordinates and rates, and the path of the output body.
void addMotorMotion(TimePlots& time, const std::string& output) {
  for (const auto& [column, title, what] :
       {std::tuple("q", "Motors' coordinates", "coordinate"), {"qdot", "Motors' rates", "rate"}}) {
    const std::vector<Indexed> columns = indexed(time.series(), column);
    if (columns.empty()) continue;
    Plot plot = time.plot(PlotGroup::motion, title, effortLabel(what, columns));
    time.addIndexed(plot, column, "q");
    time.keep(std::move(plot));
  }
  Plot path = time.plot(PlotGroup::motion, "Position of " + output, "position (m)");
  const char* const axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    time.addColumn(path, std::string("output_") + axes[i] + "_m", {axes[i], "m", i, Stroke::line, {}});
  time.keep(std::move(path));
}

/// Magnitudes of vectors `reaction_fA_x_1_N`, ….
void addReactions(TimePlots& time) {
  struct Reaction {
    const char *name, *title, *symbol;
  };
  const Reaction reactions[] = {{"fA", "Forces at the base", "f_A"},
                                {"fR", "Forces between the links", "f_R"},
                                {"fB", "Forces at the platform", "f_B"},
                                {"nA", "Moments at the base", "n_A"},
                                {"nR", "Moments between the links", "n_R"}};
  for (const Reaction& reaction : reactions) {
    const std::string column = std::string("reaction_") + reaction.name;
    const std::vector<Indexed> x = indexed(time.series(), column + "_x"), y = indexed(time.series(), column + "_y"),
                               z = indexed(time.series(), column + "_z");
    if (x.empty() || x.size() != y.size() || x.size() != z.size()) continue;
    const std::string unit = prettyUnit(x[0].unit);
    Plot plot = time.plot(PlotGroup::reactions, reaction.title,
                          fmt::format("{} ({})", reaction.name[0] == 'f' ? "force" : "moment", unit));
    for (std::size_t leg = 0; leg < x.size(); ++leg) {
      std::vector<double> size;
      for (std::size_t k = 0; k < x[leg].values->size(); ++k)
        size.push_back(std::hypot((*x[leg].values)[k], (*y[leg].values)[k], (*z[leg].values)[k]));
      time.addValues(plot, size, {"leg " + x[leg].index, unit, static_cast<int>(leg), Stroke::line, {}});
    }
    time.keep(std::move(plot));
  }
}

}  // namespace

void addSeriesPlots(const TimeSeries& series, const Motors& motors, double allowed, std::vector<Plot>& plots,
                    const std::vector<std::string>& names, const std::string& output, int worst) {
  TimePlots time(series, plots, names);
  if (time.empty()) return;
  addErrors(time, allowed);
  addEfforts(time, motors, allowed, worst);
  addMotion(time);
  addMotorMotion(time, output);
  addReactions(time);
}

std::string figureHtml(const Plot& plot, std::size_t index, const char* heading) {
  const bool drawable =
      std::any_of(plot.lines.begin(), plot.lines.end(), [&plot](const Line& line) { return isDrawable(plot, line); });
  return rendered(chart_html, {{"heading", heading},
                               {"title", plot.title},
                               {"words", inWords(plot)},
                               {"drawable", drawable},
                               {"index", index}}) +
         "\n";
}

std::string figuresHtml(const std::vector<Plot>& plots, const std::vector<PlotGroup>& groups, const char* heading) {
  std::string out;
  for (const PlotGroup group : groups)
    for (std::size_t i = 0; i < plots.size(); ++i)
      if (plots[i].group == group) out += figureHtml(plots[i], i, heading);
  return out.empty() ? "" : "<div class=\"charts\">\n" + out + "</div>";
}

}  // namespace ursula::report
