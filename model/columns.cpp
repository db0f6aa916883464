#include "model/columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/scalar.h"
#include "base/text.h"
#include "model/torque_names.h"

namespace ursula {
namespace {

/// Finds the meaning of a file's columns. `machine` is null for motions and loads, which have no motors.
class Finder {
 public:
  Finder(const CsvDialect& dialect, const std::string& file, const Manipulator* machine,
         const std::vector<std::pair<std::string, std::string>>& map = {})
      : dialect_(dialect), file_(file), machine_(machine), mapped_(dialect.header_cells.size()) {
    requireEachOnce();
    std::vector<Column> all;
    for (const auto& [name, column] : map) {
      all.push_back(target(name));
      all.back().place = place(column);
    }
    for (std::size_t i = 0; i < mapped_.size(); ++i)
      if (auto meaning = mapped_[i] ? std::nullopt : meaningOfColumn(dialect_.header_cells[i])) {
        meaning->place = i;
        all.push_back(*meaning);
      }
    const int first = countsFrom(all);
    for (const Column& column : all)
      if (machine_ != nullptr || !counts(column)) add(column, first);
  }

  /// Prefers driven coordinates to poses, and efforts to currents.
  Columns log() {
    requireAll(ColumnQuantity::time, 1);
    // If neither is whole, the error names what is missing of the one that lacks less.
    const bool driven = missingOf(ColumnQuantity::driven, motor_count) <= missingOfPoses() && missingOfPoses() > 0;
    out_.has_poses = !driven && missingOf(ColumnQuantity::driven, motor_count) > 0;
    out_.has_poses ? requirePoses() : requireAll(ColumnQuantity::driven, motor_count);
    out_.has_currents = missingOf(ColumnQuantity::effort, motor_count) == motor_count &&
                        missingOf(ColumnQuantity::current, motor_count) == 0;
    if (!out_.has_currents) requireAll(ColumnQuantity::effort, motor_count);
    out_.has_load = missingOf(ColumnQuantity::force, 3) + missingOf(ColumnQuantity::moment, 3) < 6;
    if (out_.has_load) requireLoad();  // a part of it would be a wrong load
    return finished();
  }

  Columns motionOrLoad(bool load) {
    requireAll(ColumnQuantity::time, 1);
    out_.has_poses = !load;
    out_.has_load = load;
    load ? requireLoad() : requirePoses();
    return finished();
  }

 private:
  /// Returns the contract's name.
  std::string contractName(ColumnQuantity quantity, int k) const {
    return ursula::contractName(quantity, k, machine_ == nullptr ? Motors{} : machine_->motors());
  }

  void requireEachOnce() const {
    std::vector<std::string> cells = dialect_.header_cells;
    cells.erase(std::remove(cells.begin(), cells.end(), ""), cells.end());
    std::sort(cells.begin(), cells.end());
    const auto twice = std::adjacent_find(cells.begin(), cells.end());
    if (twice != cells.end()) fail(fmt::format("duplicate column '{}', expected each name once", shown(*twice)));
  }

  Column target(const std::string& name) const {
    if (const auto meaning = meaningOfColumn(name)) return *meaning;
    fail(fmt::format("--map: '{}' is no name of a log's column, expected one such as t_s, {}, {}, p_x_m, q_w, i_1_A",
                     shown(name), contractName(ColumnQuantity::driven, 0), contractName(ColumnQuantity::effort, 0)));
  }

  std::size_t place(const std::string& column) {
    const auto& cells = dialect_.header_cells;
    const auto found = std::find(cells.begin(), cells.end(), column);
    if (found == cells.end()) fail(fmt::format("no column '{}'{}", shown(column), didYouMean(column, cells)));
    const std::size_t at = found - cells.begin();
    if (mapped_[at]) fail(fmt::format("--map: column '{}' twice", shown(column)));
    mapped_[at] = true;
    return at;
  }

  /// Returns 0 or 1, the number of the first motor.
  static int countsFrom(const std::vector<Column>& all) {
    const auto has = [&](int index) {
      return std::any_of(all.begin(), all.end(),
                         [&](const Column& each) { return counts(each) && each.index == index; });
    };
    return has(0) && !has(6) ? 0 : 1;
  }

  /// Returns whether the column's index counts motors or legs.
  static bool counts(const Column& column) {
    return column.quantity == ColumnQuantity::driven || column.quantity == ColumnQuantity::effort ||
           column.quantity == ColumnQuantity::current;
  }

  void add(Column column, int first) {
    column.name = dialect_.header_cells[column.place];
    if (counts(column)) column.index -= first;
    if (column.coordinate) {  // a leg's coordinate counts only if a motor drives it
      const Motors& motors = machine_->motors();
      const auto motor = std::find_if(motors.begin(), motors.end(), [&](const Motor& each) {
        return each.leg == column.index && each.coordinate == *column.coordinate;
      });
      if (motor == motors.end()) return;
      column.index = static_cast<int>(motor - motors.begin());
    }
    if (column.quantity == ColumnQuantity::time) column.index = 0;
    if (column.index >= motor_count || column.index < 0) return;
    if (column.quantity == ColumnQuantity::effort) requireUnit(column);
    const auto same = [&](const Column& other) {
      return other.quantity == column.quantity && other.index == column.index;
    };
    const auto other = std::find_if(found_.begin(), found_.end(), same);
    if (other == found_.end())
      found_.push_back(column);
    else if (rank(column) == rank(*other))
      doubled_.emplace_back(*other, column);
    else {
      const bool better = rank(column) > rank(*other);
      if (std::max(rank(column), rank(*other)) == 1) beside_.push_back(better ? *other : column);
      if (better) *other = column;
    }
  }

  /// A column of the map comes before one with the contract's name, and this before any other.
  int rank(const Column& column) const {
    return mapped_[column.place] ? 2 : column.name == contractName(column.quantity, column.index) ? 1 : 0;
  }

  void requireUnit(const Column& column) const {
    const auto meaning = meaningOf(column.name);
    if (!meaning || meaning->fits(machine_->motors(), column.index)) return;
    fail(fmt::format("column '{}': {}", shown(column.name), whatItTakes(machine_->motors(), column.index)));
  }

  bool has(ColumnQuantity quantity, int k) const {
    return std::any_of(found_.begin(), found_.end(),
                       [&](const Column& each) { return each.quantity == quantity && each.index == k; });
  }

  int missingOf(ColumnQuantity quantity, int count) const {
    int out = 0;
    for (int k = 0; k < count; ++k) out += has(quantity, k) ? 0 : 1;
    return out;
  }

  int missingOfPoses() const {
    return missingOf(ColumnQuantity::position, 3) +
           std::min(missingOf(ColumnQuantity::quaternion, 4), missingOf(ColumnQuantity::angle, 3));
  }

  void requirePoses() {
    requireAll(ColumnQuantity::position, 3);
    const int lacks = missingOf(ColumnQuantity::quaternion, 4);
    out_.has_angles = lacks > 0 && missingOf(ColumnQuantity::angle, 3) < std::min(lacks, 3);
    out_.has_angles ? requireAll(ColumnQuantity::angle, 3) : requireAll(ColumnQuantity::quaternion, 4);
  }

  void requireLoad() const {
    requireAll(ColumnQuantity::force, 3);
    requireAll(ColumnQuantity::moment, 3);
  }

  Columns finished() {
    for (const auto& [one, other] : doubled_)
      if (isUsed(one.quantity))
        fail(fmt::format("{} and {} may be the same, expected one{}", wordsOf(one), wordsOf(other),
                         machine_ == nullptr ? "" : "; choose by --map NAME=COLUMN"));
    for (const Column& column : found_)
      if (isUsed(column.quantity)) out_.columns.push_back(column);
    std::vector<std::string> words;
    for (std::size_t i = 0; i < dialect_.header_cells.size(); ++i) {
      const auto used = std::find_if(out_.columns.begin(), out_.columns.end(),
                                     [&](const Column& column) { return column.place == i; });
      if (used == out_.columns.end())
        out_.ignored.push_back(dialect_.header_cells[i]);
      else if (machine_ != nullptr || used->name != contractName(used->quantity, used->index))
        words.push_back(wordsOf(*used));
    }
    if (const std::string others = besideText(); !others.empty()) words.push_back("not used beside them: " + others);
    out_.read_as = fmt::format("{}", fmt::join(words, ", "));
    if (const std::string how = dialect_.words(); !how.empty())
      out_.read_as = how + (words.empty() ? "" : "; ") + out_.read_as;
    return std::move(out_);
  }

  /// Columns of a meaning that another column has, which is the contract's; and the second of two orientations.
  std::string besideText() const {
    std::vector<std::string> out;
    for (const Column& column : beside_)
      if (isUsed(column.quantity)) out.push_back("'" + shown(column.name) + "'");
    for (const Column& column : found_)
      if (out_.has_poses && !isUsed(column.quantity) &&
          (column.quantity == ColumnQuantity::quaternion || column.quantity == ColumnQuantity::angle))
        out.push_back("'" + shown(column.name) + "'");
    return fmt::format("{}", fmt::join(out, ", "));
  }

  bool isUsed(ColumnQuantity of) const {
    if (of == ColumnQuantity::driven) return !out_.has_poses;
    if (of == ColumnQuantity::position) return out_.has_poses;
    if (of == ColumnQuantity::quaternion || of == ColumnQuantity::angle)
      return out_.has_poses && out_.has_angles == (of == ColumnQuantity::angle);
    if (of == ColumnQuantity::effort) return !out_.has_currents;
    if (of == ColumnQuantity::current) return out_.has_currents;
    return of == ColumnQuantity::time || out_.has_load;
  }

  std::string wordsOf(const Column& column) const {
    static constexpr const char* words[] = {"time",   "coordinate", "position of P", "orientation", "orientation",
                                            "effort", "current",    "load",          "load"};
    std::string what = words[static_cast<int>(column.quantity)];
    if (counts(column)) what += fmt::format(" of motor {}", column.index + 1);
    return column.factor == 1 ? fmt::format("'{}' {}", shown(column.name), what)
                              : fmt::format("'{}' {} × {:.6g}", shown(column.name), what, column.factor);
  }

  void requireAll(ColumnQuantity quantity, int count) const {
    for (int k = 0; k < count; ++k)
      if (!has(quantity, k)) missing(contractName(quantity, k));
  }

  [[noreturn]] void missing(const std::string& name) const {
    const auto& cells = dialect_.header_cells;
    std::vector<std::string> free;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (std::none_of(found_.begin(), found_.end(), [i](const Column& column) { return column.place == i; }))
        free.push_back(cells[i]);
    fail(fmt::format("missing column '{}', expected it in the header{}; found {}{}", name, didYouMean(name, free),
                     shown(fmt::format("'{}'", fmt::join(cells, "', '")), 400),
                     machine_ == nullptr ? "" : "; if one of them holds it, add --map " + name + "=COLUMN"));
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw CsvError(fmt::format("{}:{}: error: {}", shownPath(file_), std::max(dialect_.header, 1), what));
  }

  const CsvDialect& dialect_;
  std::string file_;
  const Manipulator* machine_;
  std::vector<Column> found_;
  std::vector<std::pair<Column, Column>> doubled_;
  std::vector<Column> beside_;  ///< whose meaning a column with the contract's name has
  std::vector<bool> mapped_;
  Columns out_;
};

/// A value in SI units. It is divided by a power of ten, so that 70 ms are the double 0.07 s.
double inSI(double value, double factor) {
  const double parts = std::round(1 / factor);
  return parts > 1 && factor != degree ? value / parts : value * factor;
}

/// Adds `q_w` … `q_z`, which the angles in `table` are.
void addQuaternions(CsvTable& table) {
  const std::vector<double>* angles[] = {&table.at("roll_rad"), &table.at("pitch_rad"), &table.at("yaw_rad")};
  std::vector<std::vector<double>> columns(4, std::vector<double>(table.rows()));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Eigen::Vector4d q = quaternionOfAngles({(*angles[0])[row], (*angles[1])[row], (*angles[2])[row]});
    for (std::size_t k = 0; k < 4; ++k) columns[k][row] = q(static_cast<Eigen::Index>(k));
  }
  for (std::size_t k = 0; k < 4; ++k) {
    table.names.push_back(std::string("q_") + "wxyz"[k]);
    table.columns.push_back(std::move(columns[k]));
    table.last_places.emplace_back(table.rows());
  }
}

}  // namespace

Eigen::Vector4d quaternionOfAngles(const Vector3d& roll_pitch_yaw) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(roll_pitch_yaw(2), Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(roll_pitch_yaw(1), Vector3d::UnitY()) *
                               Eigen::AngleAxisd(roll_pitch_yaw(0), Vector3d::UnitX());
  return {q.w(), q.x(), q.y(), q.z()};
}

Columns findLogColumns(const CsvDialect& dialect, const std::string& file,
                       const std::vector<std::pair<std::string, std::string>>& map, const Manipulator& machine) {
  return Finder(dialect, file, &machine, map).log();
}

CsvTable readByMeaning(const std::filesystem::path& file, bool loads) {
  const std::string text = readCsvText(file), name = file.string();
  CsvOptions options;
  options.dialect = guessDialect(text, file);
  if (options.dialect.header_cells.empty()) return parseCsv(text, file);  // reports the defect of an empty file
  const Columns found = Finder(options.dialect, name, nullptr).motionOrLoad(loads);
  const auto of = [&found](const std::string& column) {
    return std::find_if(found.columns.begin(), found.columns.end(),
                        [&](const Column& each) { return each.name == column; });
  };
  options.wanted = [&](const std::string& column) { return of(column) != found.columns.end(); };
  CsvTable table = parseCsv(text, file, options);
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const Column& column = *of(table.names[i]);
    for (double& value : table.columns[i]) value = inSI(value, column.factor);
    const auto places = static_cast<int>(std::lround(std::log10(std::abs(inSI(1.0, column.factor)))));
    for (int& place : table.last_places[i]) place += places;
    table.names[i] = contractName(column.quantity, column.index, {});
  }
  if (found.has_angles) addQuaternions(table);
  return table;
}

std::string meaningInWords(const std::filesystem::path& file, bool loads) {
  const CsvDialect dialect = guessDialect(readCsvText(file), file);
  return Finder(dialect, file.string(), nullptr).motionOrLoad(loads).read_as;
}

}  // namespace ursula
