#include <fmt/format.h>

#include "model/scenario_sections.h"

namespace ursula {
namespace {

std::vector<TimedWrench> rowsOf(const std::vector<TomlSection>& table) {
  std::vector<TimedWrench> rows;
  for (const TomlSection& entry : table) {
    entry.allowOnly(scenarioTable("load.table"));
    TimedWrench row;
    entry.require("time", row.time);
    entry.read("force", row.wrench.force);
    entry.read("moment", row.wrench.moment);
    rows.push_back(row);
  }
  return rows;
}

std::vector<TimedWrench> rowsOf(const CsvTable& table) {
  const auto& time = table.at("t_s");
  const std::vector<double>* force[] = {&table.at("f_x_N"), &table.at("f_y_N"), &table.at("f_z_N")};
  const std::vector<double>* moment[] = {&table.at("m_x_Nm"), &table.at("m_y_Nm"), &table.at("m_z_Nm")};
  std::vector<TimedWrench> rows(table.rows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].time = time[i];
    if (i > 0 && !(time[i] > time[i - 1]))
      throw CsvError(
          fmt::format("{}: error: time {}, expected > {}, the time before", table.place(i), time[i], time[i - 1]));
    for (int k = 0; k < 3; ++k) rows[i].wrench.force(k) = (*force[k])[i];
    for (int k = 0; k < 3; ++k) rows[i].wrench.moment(k) = (*moment[k])[i];
  }
  if (rows.size() < 2) throw CsvError(fmt::format("{}: error: 1 row, expected >= 2", table.place(0)));
  return rows;
}

}  // namespace

std::shared_ptr<const Load> readLoad(const TomlSection& table) {
  const ScenarioTable& keys = scenarioTable("load");
  table.allowOnly(keys);
  const bool constant = table.has("force") || table.has("moment");
  const int ways = (constant ? 1 : 0) + (table.has("file") ? 1 : 0) + (table.has("table") ? 1 : 0);
  if (ways != 1)
    table.fail(fmt::format("{}, expected one of: force and moment, a file, a table",
                           ways == 0 ? "no load" : "more than one description of the load"));
  auto load = std::make_shared<Load>();
  table.read("force", load->force);
  table.read("moment", load->moment);
  table.read("point", load->point);
  if (const auto frame = table.readChoice(keys.key("frame")))
    load->frame = *frame == 0 ? Load::Frame::base : Load::Frame::platform;
  if (table.has("file")) load->history = std::make_shared<LoadHistory>(rowsOf(readCsvBeside(table, "file", true)));
  if (table.has("table")) load->history = std::make_shared<LoadHistory>(rowsOf(table.sections("table")));
  return load;
}

}  // namespace ursula
