#include "model/motor_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/csv_dialect.h"
#include "base/csv_digits.h"
#include "base/scalar.h"
#include "base/text.h"
#include "base/utf8.h"
#include "model/mechanism_scenario.h"
#include "model/torque_names.h"

namespace ursula {
namespace {

/// What a column holds: the contract's column, and the factor to its unit.
struct MotorColumn {
  std::string name;
  double factor = 1;
  int rank = 0;  ///< of several columns for one name, that of the highest rank is taken
};

constexpr int by_joint = 0, by_number = 2, by_map = 4, in_si = 1;

/// All names of motors' columns that a file may have.
std::map<std::string, MotorColumn> motorNames(const Mechanism& mechanism) {
  std::map<std::string, MotorColumn> out;
  for (const int rank : {by_number, by_joint})
    for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
      for (const std::string of : {"q", "qdot", "qddot"}) {
        const std::string name = motorColumn(mechanism, k, of.c_str()), number = fmt::format("{}_{}_", of, k + 1);
        const std::string unit = name.substr(number.size()), joint = mechanism.motor(k).name + "_";
        const std::string head = rank == by_number ? number : of == "q" ? joint : of + "_" + joint;
        const bool slides = mechanism.motor(k).slides();
        const std::string other = (slides ? "mm" : "deg") + unit.substr(slides ? 1 : 3);
        out.emplace(head + unit, MotorColumn{name, 1, rank + in_si});
        out.emplace(head + other, MotorColumn{name, slides ? 1e-3 : degree, rank});
      }
  return out;
}

/// Finds what each column of a header holds.
class MotorFinder {
 public:
  MotorFinder(const std::vector<std::string>& header, const Mechanism& mechanism, const std::vector<std::string>& map)
      : header_(header), names_(motorNames(mechanism)) {
    for (const std::string& text : map) takeMapped(text);
    for (const std::string& column : header_)
      if (sources_.count(column) == 0)
        if (const auto meaning = meaningOfName(column)) take(column, *meaning);
  }

  /// The column of each name of the contract, and how it is converted.
  struct Source {
    std::string column;
    MotorColumn meaning;
  };
  const std::map<std::string, Source>& found() const { return found_; }
  const std::vector<std::string>& mapped() const { return mapped_; }

 private:
  std::optional<MotorColumn> meaningOfName(const std::string& name) const {
    const auto motor = names_.find(name);
    if (motor != names_.end()) return motor->second;
    const auto time = meaningOf(name);
    if (!time || time->motor >= 0) return std::nullopt;
    return MotorColumn{"t_s", std::pow(10.0, time->power), name == "t_s" ? by_number + in_si : by_number};
  }

  void takeMapped(const std::string& text) {
    const auto [name, column] = mapEntry(text);
    const auto meaning = meaningOfName(name);
    if (!meaning || std::find(header_.begin(), header_.end(), column) == header_.end()) return;
    const auto other = found_.find(meaning->name);
    if (other != found_.end() || sources_.count(column) != 0)
      throw CsvError(fmt::format("--map {}: error: {} is mapped twice", shown(text),
                                 other != found_.end() ? meaning->name : "column '" + shown(column) + "'"));
    mapped_.push_back(text);
    sources_.emplace(column, meaning->name);
    take(column, {meaning->name, meaning->factor, by_map});
  }

  void take(const std::string& column, const MotorColumn& meaning) {
    const auto [at, is_new] = found_.emplace(meaning.name, Source{column, meaning});
    if (!is_new && meaning.rank > at->second.meaning.rank) at->second = {column, meaning};
  }

  const std::vector<std::string>& header_;
  const std::map<std::string, MotorColumn> names_;
  std::map<std::string, Source> found_;
  std::map<std::string, std::string> sources_;  ///< mapped columns and their names
  std::vector<std::string> mapped_;
};

void requireColumns(const CsvTable& table, const Mechanism& mechanism, const CsvDialect& dialect, bool has_time) {
  for (std::size_t k = has_time ? 0 : 1; k <= mechanism.motorCount(); ++k) try {
      static_cast<void>(table.at(k == 0 ? "t_s" : motorColumn(mechanism, k - 1, "q")));
    } catch (const CsvError& error) {
      throw CsvError(fmt::format("{}; its columns are: {}; name one of them by --map NAME=COLUMN", error.what(),
                                 shown(fmt::format("{}", fmt::join(dialect.header_cells, ", ")), 1000)));
    }
}

}  // namespace

std::pair<std::string, std::string> mapEntry(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return {std::string(trimmedCell(text)), ""};
  return {std::string(trimmedCell(text.substr(0, equals))), utf8(std::string(trimmedCell(text.substr(equals + 1))))};
}

MotorTable readMotorTable(const std::filesystem::path& file, const Mechanism& mechanism,
                          const std::vector<std::string>& map, bool has_time) {
  const std::string text = readCsvText(file);
  CsvOptions options;
  options.dialect = guessDialect(text, file);
  const MotorFinder finder(options.dialect.header_cells, mechanism, map);
  std::map<std::string, MotorFinder::Source> by_column;
  for (const auto& [name, source] : finder.found()) by_column.emplace(source.column, source);
  options.wanted = [&by_column](const std::string& column) { return by_column.count(column) != 0; };
  MotorTable out{parseCsv(text, file, options), {}, options.dialect.words(), finder.mapped()};
  CsvTable& table = out.table;
  const CsvTable printed = table;
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    const MotorColumn& meaning = by_column.at(printed.names[c]).meaning;
    out.half_digits.push_back(meaning.factor * halfDigit(printed, printed.names[c]));
    table.names[c] = meaning.name;
    for (double& value : table.columns[c]) value *= meaning.factor;
    if (printed.names[c] == meaning.name) continue;
    out.read_as += fmt::format("{}{} = '{}'", out.read_as.empty() ? "" : ", ", meaning.name, shown(printed.names[c]));
    if (meaning.factor != 1) out.read_as += fmt::format(" times {:.7g}", meaning.factor);
  }
  requireColumns(table, mechanism, options.dialect, has_time);
  return out;
}

}  // namespace ursula
