// The audit for a terminal, and as JSON.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "parts/audit/audit.h"
#include "parts/audit/remarks.h"

namespace ursula {
namespace audit {
namespace {

constexpr std::size_t equation_width = 15, label_width = 9, residual_width = 32, page_width = 120;
constexpr std::size_t text_width = page_width - equation_width - label_width - residual_width;

/// Counts code points without combining marks, which take no column.
std::size_t columns(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    if ((byte & 0xC0U) == 0x80U) continue;
    const bool combining = byte == 0xCCU || (byte == 0xCDU && static_cast<unsigned char>(text[k + 1]) < 0xB0U);
    if (!combining) ++count;
  }
  return count;
}

std::string padded(const std::string& text, std::size_t width) {
  const std::size_t has = columns(text);
  return text + std::string(has < width ? width - has : 1, ' ');
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t space = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, space - start);
    if (!lines.back().empty() && columns(lines.back()) + 1 + columns(word) > width) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    start = space + 1;
  }
  return lines;
}

/// One labelled line with wrapped text; the residual is at the right of the first line.
std::string line(const std::string& equation, const std::string& label, const std::string& text,
                 const std::string& residual) {
  if (columns(equation) >= equation_width) return equation + "\n" + line("", label, text, residual);
  std::string out;
  const bool wide = residual.empty();
  bool first = true;
  for (const std::string& part : wrapped(text, text_width + (wide ? residual_width : 0) - 1)) {
    std::string row = padded(first ? equation : "", equation_width) + padded(first ? label : "", label_width);
    row += first && !wide ? padded(part, text_width) + residual : part;
    row.erase(row.find_last_not_of(' ') + 1);
    out += row + "\n";
    first = false;
  }
  return out;
}

std::string effectText(const AuditEffect& effect, double duration) {
  if (!effect.refused.empty()) return "no torques: " + effect.refused;
  return fmt::format("torques off by {} N m, {} of the largest; replay 1 mm off: {}, 10 mm: {}, end: {}",
                     number(effect.torque_error), number(effect.relative_error), instant(effect.to_1_mm),
                     instant(effect.to_10_mm), ending(effect, duration));
}

std::string wrongRow(const AuditRow& row, double duration) {
  std::string out = line(row.equation, "printed", row.printed, residualOf(row.residual_printed, row));
  out += line("", "holds", row.holds, number(row.residual_holds));
  if (!row.note.empty()) out += line("", "", row.note, "");
  if (row.effect) out += line("", "does", effectText(*row.effect, duration), "");
  return out;
}

std::string heading(const std::string& text) { return "\n" + text + "\n" + std::string(page_width, '-') + "\n"; }

std::string section(const Audit& all, AuditRow::Kind kind) {
  std::string out;
  for (const AuditRow& row : all.rows)
    if (row.kind == kind)
      out += kind == AuditRow::Kind::holds ? line(row.equation, "", row.printed, residualOf(row.residual_printed, row))
                                           : wrongRow(row, all.duration);
  return out;
}

nlohmann::ordered_json effectJson(const AuditEffect& effect) {
  if (!effect.refused.empty()) return {{"refused", effect.refused}};
  nlohmann::ordered_json json = {{"torque_error_Nm", effect.torque_error},
                                 {"torque_error_relative", effect.relative_error}};
  json["replay_1_mm_s"] = effect.to_1_mm < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(effect.to_1_mm);
  json["replay_10_mm_s"] = effect.to_10_mm < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(effect.to_10_mm);
  json["replay_end_s"] = effect.replay_end;
  json["replay_end_deviation_m"] = effect.end_deviation;
  return json;
}

const char* name(AuditRow::Kind kind) {
  static constexpr const char* names[] = {"holds", "fails", "misprint"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace
}  // namespace audit

std::string auditText(const Audit& result) {
  std::string out = fmt::format(
      "Audit of the paper's formulas: {}, t_f = {} s. Residuals in 50 digits, each formula alone with exact inputs,\n"
      "largest over six legs at {} instants, beside the size of the formula's value. The leg's index is left out.\n",
      result.scenario, result.duration, result.instants.size());
  out += audit::heading("Do not hold as printed in our source");
  out += audit::section(result, AuditRow::Kind::fails);
  for (const AuditRow& row : result.together)
    out += audit::line(row.equation, "does", audit::effectText(*row.effect, result.duration), "");
  out += audit::heading("Misprints: dimensions or types do not match, or a symbol belongs to another quantity");
  out += audit::section(result, AuditRow::Kind::misprint);
  out += audit::heading("Hold as printed");
  out += audit::section(result, AuditRow::Kind::holds);
  out += audit::heading("Further statements");
  for (const AuditRemark& remark : result.remarks) {
    out += audit::line(remark.place, "says", remark.says, "");
    out += audit::line("", "found", remark.found, "");
  }
  return out;
}

std::string auditJson(const Audit& result) {
  nlohmann::ordered_json json = {{"scenario", result.scenario},
                                 {"duration_s", result.duration},
                                 {"instants_s", result.instants},
                                 {"largest_torque_Nm", result.largest_torque},
                                 {"torque_samples", result.torque_samples},
                                 {"replay_tolerance", result.replay_tolerance}};
  json["formulas"] = nlohmann::ordered_json::array();
  for (const AuditRow& row : result.rows) {
    nlohmann::ordered_json one = {{"equation", row.equation},
                                  {"verdict", audit::name(row.kind)},
                                  {"printed", row.printed},
                                  {"holds", row.kind == AuditRow::Kind::holds ? row.printed : row.holds},
                                  {"unit", row.unit},
                                  {"residual_printed", row.residual_printed},  // null if undefined
                                  {"residual_holds", row.residual_holds},
                                  {"size", row.size},
                                  {"note", row.note}};
    if (row.effect) one["effect"] = audit::effectJson(*row.effect);
    json["formulas"].push_back(std::move(one));
  }
  for (const AuditRow& row : result.together) json["together"][row.equation] = audit::effectJson(*row.effect);
  for (const AuditRemark& remark : result.remarks)
    json["remarks"].push_back({{"place", remark.place}, {"says", remark.says}, {"found", remark.found}});
  return json.dump(2) + "\n";
}

}  // namespace ursula
