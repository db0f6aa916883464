#include "apps/torque_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>

#include "apps/streams.h"
#include "base/shown_text.h"
#include "validation/subject/effort_columns.h"

namespace ursula {

void addMapOption(CLI::App& verb, std::vector<std::string>& map) {
  verb.add_option(
          "--map", map,
          "The name that the torque file gives to a column, such as tau_1_Nm=tau1 or t_ms=Time; may be repeated")
      ->type_name("NAME=COLUMN")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

TorqueFile readTorquesAloud(const std::string& file, const std::vector<std::string>& map, const Motors& motors) {
  const TorqueFile torques = readTorqueFile(file, parseColumnMap(map, motors), motors);
  if (!torques.read_as.empty()) say("{}: read as: {}\n", shownPath(file), torques.read_as);
  if (!torques.ignored.empty())
    say("{}: columns other than t_s, {} … {} are ignored: {}\n", shownPath(file), effortColumn(motors, 0),
        effortColumn(motors, motor_count - 1), shown(fmt::format("{}", fmt::join(torques.ignored, ", ")), 400));
  return torques;
}

}  // namespace ursula
