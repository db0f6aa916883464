#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parts/identify/identify.h"
#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/page/plots.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula {

extern const std::string_view identify_table_html, identify_list_html;

namespace {

using report::escaped;
using report::HtmlValue;
using report::Line;
using report::listOf;
using report::Plot;
using report::quantity;
using report::rendered;
using report::Stroke;

constexpr std::size_t buckets = 400, most_rows = 60;

std::vector<double> columnOf(const IdentifyResult& result, const char* what, std::size_t k) {
  return *result.series.find(fmt::format("{}_{}_{}", what, k + 1, result.motors[k].unit));
}

/// Returns a + factor · b.
std::vector<double> sum(std::vector<double> a, double factor, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
  return a;
}

Plot plotOf(const IdentifyResult& result, std::size_t k, const std::string& title, const std::string& what,
            std::vector<Line> lines) {
  Plot plot;
  plot.title = fmt::format("{} of motor {}", title, k + 1);
  plot.x_label = "t (s)";
  plot.y_label = fmt::format("{} ({})", what, report::prettyUnit(result.motors[k].unit));
  plot.over_time = plot.tube = true;
  plot.x = *result.series.find("t_s");
  plot.rows = plot.x.size();
  plot.lines = std::move(lines);
  return thinned(plot, buckets);
}

/// Plots E = S − D, and what the fit leaves, with the band of 1.96 u_val that holds a right model.
Plot errorPlot(const IdentifyResult& result, std::size_t k) {
  const std::string unit = result.motors[k].unit;
  const std::vector<double> measured = columnOf(result, "tau", k), u = columnOf(result, "u_val", k),
                            none(measured.size(), 0.0);
  return plotOf(
      result, k, "Difference", "model less measured",
      {{"uncertainty, 95 %", unit, 0, Stroke::limit, sum(none, 1.96, u)},
       {"− uncertainty", unit, 0, Stroke::limit, sum(none, -1.96, u)},
       {"model less measured", unit, 0, Stroke::line, sum(columnOf(result, "model", k), -1, measured)},
       {"fitted model less measured", unit, 2, Stroke::line, sum(columnOf(result, "fitted", k), -1, measured)}});
}

/// Plots measured and predicted effort with a band of 1.96 u_val about the model.
Plot effortPlot(const IdentifyResult& result, std::size_t k) {
  const std::string unit = result.motors[k].unit;
  const std::vector<double> model = columnOf(result, "model", k), u = columnOf(result, "u_val", k);
  return plotOf(result, k, unit == "N" ? "Force" : "Torque", unit == "N" ? "force" : "torque",
                {{"model + uncertainty", unit, 0, Stroke::limit, sum(model, 1.96, u)},
                 {"model − uncertainty", unit, 0, Stroke::limit, sum(model, -1.96, u)},
                 {"measured", unit, 1, Stroke::ghost, columnOf(result, "tau", k)},
                 {"model", unit, 0, Stroke::line, model},
                 {"fitted model", unit, 2, Stroke::line, columnOf(result, "fitted", k)}});
}

/// Adds plots to the page. Returns their HTML.
std::string charts(const std::vector<Plot>& plots, report::Page& page) {
  std::string out;
  for (const Plot& plot : plots) {
    page.charts.push_back(plot);
    out += report::figureHtml(plot, page.charts.size() - 1, "h3");
  }
  return "<div class=\"charts\">" + out + "</div>";
}

Plot spectrumPlot(const IdentifyResult& result) {
  Plot plot;
  plot.title = "What the fitted model leaves";
  plot.x_label = "f (Hz)";
  plot.y_label = "density (effort²/Hz)";
  plot.log_y = true;
  plot.x = *result.spectra.find("f_Hz");
  plot.rows = plot.x.size();
  for (std::size_t k = 0; k < result.motors.size(); ++k)
    plot.lines.push_back({fmt::format("motor {}", k + 1), result.motors[k].unit + "²/Hz", static_cast<int>(k),
                          Stroke::line,
                          *result.spectra.find(fmt::format("residual_{}_{}2_Hz", k + 1, result.motors[k].unit))});
  return plot;
}

/// Returns a table whose cells are HTML. It says that `more` rows are left out.
std::string tableOf(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows,
                    std::size_t more = 0) {
  if (rows.empty()) return "";
  const auto row = [&heads](const std::vector<std::string>& cells) {
    std::vector<HtmlValue> further;
    for (std::size_t k = 1; k < cells.size(); ++k) further.push_back({{"head", heads[k]}, {"text", cells[k]}});
    return HtmlValue{{"first", cells[0]}, {"cells", further}};
  };
  return rendered(identify_table_html,
                  {{"heads", heads}, {"rows", listOf(rows, row)}, {"more", more > 0 ? std::to_string(more) : ""}});
}

std::string numberText(double x) { return report::number(x, 6); }

/// Draws the interval as a bar from −3 to 3 tolerances of the number, or tenths of its size without a tolerance.
std::string barOf(const MeasuredNumber& n) {
  constexpr double width = 160, height = 14;
  const double unit = n.tolerance > 0           ? n.tolerance
                      : std::abs(n.nominal) > 0 ? 0.1 * std::abs(n.nominal)
                                                : n.uncertainty;
  if (!(unit > 0)) return "";
  const auto x = [&](double value) { return width * std::clamp(((value - n.nominal) / unit + 3) / 6, 0.0, 1.0); };
  return fmt::format(
      "<svg class=\"static\" width=\"{0}\" height=\"{1}\" role=\"img\" aria-label=\"{6:.3g} of its {7}\"><rect "
      "x=\"{2:.1f}\" y=\"0\" width=\"{3:.1f}\" height=\"{1}\" fill=\"currentColor\" opacity=\".12\"/><line "
      "x1=\"{4:.1f}\" x2=\"{5:.1f}\" y1=\"7\" y2=\"7\" stroke=\"currentColor\" stroke-width=\"2\"/><circle "
      "cx=\"{8:.1f}\" cy=\"7\" r=\"3\" fill=\"currentColor\"/></svg>",
      width, height, x(n.nominal - unit), x(n.nominal + unit) - x(n.nominal - unit), x(n.low), x(n.high),
      (n.value - n.nominal) / unit, n.tolerance > 0 ? "tolerance" : "tenth", x(n.value));
}

std::string numbersTable(std::vector<MeasuredNumber> numbers, bool combinations) {
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(), [](const MeasuredNumber& n) { return !n.identified; }),
                numbers.end());
  std::vector<std::vector<std::string>> rows;
  for (const MeasuredNumber& n : numbers) {
    if (rows.size() == most_rows) break;
    rows.push_back({escaped(n.name), numberText(n.nominal), numberText(n.value),
                    "± " + report::number(0.5 * (n.high - n.low)), escaped(n.unit),
                    n.tolerance >= 0 ? report::number(n.tolerance) : "–", barOf(n)});
  }
  return tableOf({combinations ? "Combination" : "Number", "Model", "Measured", "95 %", "Unit", "Tolerance",
                  "−3 … 3 tolerances, or tenths of the number"},
                 rows, numbers.size() - rows.size());
}

/// The table of the first screen: what was measured, and how far the model is off.
std::string agreementTable(const IdentifyResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < result.motors.size(); ++k) {
    const MotorAgreement& m = result.motors[k];
    rows.push_back({fmt::format("motor\u00a0{}", k + 1), quantity(m.effort, m.unit), quantity(m.deviation, m.unit),
                    quantity(m.largest, m.unit), fmt::format("{:.4g}\u00a0s", m.largest_at_s),
                    quantity(1.96 * m.u_val, m.unit), fmt::format("{:.1f}\u00a0%", 100 * m.within),
                    quantity(m.left, m.unit)});
  }
  return tableOf({"Motor", "Measured, rms", "Off the model, rms", "Largest", "at", "Uncertainty, 95 %", "Within it",
                  "Off the fitted model"},
                 rows);
}

/// The parts of the uncertainty by ASME V&V 20.
std::string motorsTable(const IdentifyResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < result.motors.size(); ++k) {
    const MotorAgreement& m = result.motors[k];
    rows.push_back({fmt::format("motor\u00a0{}", k + 1), report::number(m.effort), report::number(m.deviation),
                    report::number(m.u_num), report::number(m.u_input), report::number(m.u_D), report::number(m.u_val),
                    fmt::format("{:.1f} %", 100 * m.within), report::number(m.left),
                    m.expected > 0 ? report::number(m.expected) : "–", m.unit});
  }
  return tableOf({"Motor", "Effort", "E = S − D", "u_num", "u_input", "u_D", "u_val", "within 1.96 u_val",
                  "left by the fit", "noise alone", "Unit"},
                 rows);
}

std::string causesTable(const IdentifyResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (const MeasuredCause& c : result.causes) {
    std::string others;
    for (std::size_t k = 0; k < std::min<std::size_t>(c.as_well.size(), 4); ++k)
      others += (k > 0 ? ", " : "") + escaped(c.as_well[k]);
    rows.push_back({escaped(c.kind), escaped(c.parameter.empty() ? c.what : c.parameter), numberText(c.expected),
                    numberText(c.found) + " ± " + report::number(1.96 * c.uncertainty), escaped(c.unit),
                    c.tolerances != 0 ? report::number(c.tolerances) : "–",
                    fmt::format("{:.0f}\u00a0%", 100 * c.explained), others});
  }
  return tableOf({"Kind", "What", "Model", "Log", "Unit", "Tolerances", "Explains", "As well"}, rows);
}

/// A delay below its own uncertainty is none.
std::string delayText(const IdentifyResult& result) {
  return std::abs(result.delay) < 1.96 * result.delay_uncertainty ? "none seen" : quantity(result.delay, "s");
}

std::string list(const std::vector<std::string>& items, bool columns) {
  return items.empty() ? "" : rendered(identify_list_html, {{"items", items}, {"columns", columns}});
}

}  // namespace

std::string identifyPage(const IdentifyResult& result) {
  report::Page page;
  page.kind = "Measured log";
  page.title = result.scenario.name;
  page.subtitle = result.file;
  page.verdict = result.verdict;
  page.sentence = report::unbroken(result.sentence);
  std::vector<std::string> findings;
  for (const LogFinding& each : result.findings) findings.push_back(each.kind + ": " + each.what);
  std::string errors, efforts, spectrum;
  if (!result.series.names.empty()) {
    std::vector<Plot> error_plots, effort_plots;
    for (std::size_t k = 0; k < result.motors.size(); ++k) {
      error_plots.push_back(errorPlot(result, k));
      effort_plots.push_back(effortPlot(result, k));
    }
    efforts = agreementTable(result) + charts(effort_plots, page);
    errors = charts(error_plots, page);
    spectrum = motorsTable(result) + charts({spectrumPlot(result)}, page);
    page.figures = {
        {"Log", quantity(result.duration, "s"), fmt::format("{} rows", result.rows)},
        {"Delay of the efforts", delayText(result), "± " + quantity(1.96 * result.delay_uncertainty, "s", 2)},
        {"Compared up to", quantity(result.effort_cut, "Hz"), "by a low pass"},
        {"Periods", fmt::format("{}", result.periods), quantity(result.duration / result.periods, "s", 4) + " each"}};
  }
  page.sections = {{"causes", "What may be wrong", causesTable(result)},
                   {"findings", "What the log shows", list(findings, false)},
                   {"efforts", "Measured against model", efforts},
                   {"errors", "Differences", errors},
                   {"parameters", "Numbers that the motion shows", numbersTable(result.numbers, false)},
                   {"combinations", "Combinations that it shows", numbersTable(result.combinations, true)},
                   {"unseen", "What this motion cannot see", list(result.unseen, true)},
                   {"spectrum", "Uncertainty and what the fit leaves", spectrum}};
  page.script = report::charts_script;
  page.footer = fmt::format("<p>ursula {}. Read as: {}</p>", escaped(result.version), escaped(result.read_as));
  return report::pageHtml(page);
}

}  // namespace ursula
