#include "tests/model/second_reading/file_as_written.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "base/real50.h"
#include "base/text.h"
#include "tests/model/second_reading/written_numbers.h"

namespace ursula {
namespace {

using namespace written;

// --- tables beside the file
// -------------------------------------------------------------------------------------------

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(trimmed(cell));
  return out;
}

/// Rows by the names of their columns; none if the file cannot be read any more.
std::vector<std::map<std::string, double>> rowsOf(const std::filesystem::path& file) {
  std::vector<std::map<std::string, double>> rows;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) return rows;
  if (line.rfind("\xEF\xBB\xBF", 0) == 0) line.erase(0, 3);
  const std::vector<std::string> names = cells(line);
  while (std::getline(in, line)) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> values = cells(line);
    std::map<std::string, double> row;
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i)
      row[names[i]] = leadingNumber(values[i]).value;
    rows.push_back(std::move(row));
  }
  return rows;
}

double cell(const std::map<std::string, double>& row, const std::string& name) {
  const auto found = row.find(name);
  return found == row.end() ? none : found->second;
}

Vector3d axes(const std::map<std::string, double>& row, const std::string& before, const std::string& after) {
  return {cell(row, before + "x" + after), cell(row, before + "y" + after), cell(row, before + "z" + after)};
}

// --- motion and load
// --------------------------------------------------------------------------------------------------

/// π with more digits than any number here.
const Real50 pi("3.14159265358979323846264338327950288419716939937510582097494");

Real50 inRadians(const View& degrees) { return Real50(number(degrees)) * pi / 180; }

/// An angle, rad, by its key in radians or in degrees.
double angleOr(const View& table, const std::string& key, double otherwise) {
  const View degrees = table[key + "_deg"];
  return degrees ? static_cast<double>(inRadians(degrees)) : numberOr(table[key], otherwise);
}

/// A turn by `angle` that takes axis j to axis k.
Matrix3<Real50> turn(int j, int k, const Real50& angle) {
  Matrix3<Real50> out = Matrix3<Real50>::Identity();
  out(j, j) = out(k, k) = cos(angle);
  out(k, j) = sin(angle);
  out(j, k) = -out(k, j);
  return out;
}

/// Finds the largest entry from the squares that trace and diagonal give, and the others from the off-diagonal entries.
Eigen::Vector4d quaternionOf(const Matrix3<Real50>& Q) {
  Eigen::Matrix<Real50, 4, 1> squares;  // 4 w², 4 x², …
  squares(0) = 1 + Q.trace();
  for (int k = 0; k < 3; ++k) squares(k + 1) = 1 - Q.trace() + 2 * Q(k, k);
  Eigen::Index largest = 0;
  squares.maxCoeff(&largest);
  Eigen::Matrix<Real50, 4, 1> q;
  const Real50 four = 2 * sqrt(squares(largest));
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Real50 with_w = Q(j, i) - Q(i, j), across = Q(i, j) + Q(j, i);
    if (largest == 0) q(k + 1) = with_w / four;
    if (largest == k + 1) q(0) = with_w / four;
    if (largest == i + 1) q(j + 1) = across / four;
    if (largest == j + 1) q(i + 1) = across / four;
  }
  q(largest) = four / 4;
  Eigen::Vector4d out;
  for (int k = 0; k < 4; ++k) out(k) = abs(q(k)) < Real50(1e-40) ? 0 : static_cast<double>(q(k));
  return out;
}

/// [w, x, y, z], or roll, pitch and yaw about x, y and z of B, one after the other.
Eigen::Vector4d orientationOf(const View& table) {
  const View angles = table["rpy_deg"];
  if (!angles) return numbers<4>(table["orientation"]);
  const Matrix3<Real50> roll = turn(1, 2, inRadians(angles[0])), pitch = turn(2, 0, inRadians(angles[1]));
  return quaternionOf(turn(0, 1, inRadians(angles[2])) * pitch * roll);
}

HelixParameters helixOf(const View& table) {
  HelixParameters helix;
  helix.duration = number(table["duration"]);
  helix.radius = number(table["radius"]);
  helix.pitch = number(table["pitch"]);
  helix.start_angle = angleOr(table, "start_angle", none);
  helix.end_angle = angleOr(table, "end_angle", none);
  helix.phase = angleOr(table, "phase", 0);
  helix.height_phase = angleOr(table, "height_phase", 0);
  helix.start_rate = numberOr(table["start_rate"], 0);
  helix.end_rate = numberOr(table["end_rate"], 0);
  helix.start_acceleration = numberOr(table["start_acceleration"], 0);
  helix.end_acceleration = numberOr(table["end_acceleration"], 0);
  return helix;
}

TimedPose poseOf(const View& table, double time) { return {time, numbers<3>(table["position"]), orientationOf(table)}; }

TrajectoryAsWritten trajectoryOf(const View& table, const std::filesystem::path& folder) {
  TrajectoryAsWritten out;
  out.kind = table["kind"].value_or(std::string());
  out.duration = number(table["duration"]);
  if (out.kind == "helix") out.helix = helixOf(table);
  if (out.kind == "hold") out.poses = {poseOf(table, 0)};
  if (out.kind == "waypoints")
    for (std::size_t i = 0; i < sizeOf(table["points"]); ++i)
      out.poses.push_back(poseOf(table["points"][i], number(table["points"][i]["time"])));
  if (out.kind == "samples")
    for (const auto& row : rowsOf(folder / table["file"].value_or(std::string())))
      out.poses.push_back({cell(row, "t_s"),
                           axes(row, "p_", "_m"),
                           {cell(row, "q_w"), cell(row, "q_x"), cell(row, "q_y"), cell(row, "q_z")}});
  return out;
}

LoadAsWritten loadOf(const View& table, const std::filesystem::path& folder) {
  LoadAsWritten out;
  out.force = vectorOr(table["force"], Vector3d::Zero());
  out.moment = vectorOr(table["moment"], Vector3d::Zero());
  out.point = vectorOr(table["point"], Vector3d::Zero());
  out.frame = table["frame"].value_or(std::string("base"));
  out.tabulated = table["table"] || table["file"];
  for (std::size_t i = 0; i < sizeOf(table["table"]); ++i) {
    const View row = table["table"][i];
    out.rows.push_back(
        {number(row["time"]), {vectorOr(row["force"], Vector3d::Zero()), vectorOr(row["moment"], Vector3d::Zero())}});
  }
  if (table["file"])
    for (const auto& row : rowsOf(folder / table["file"].value_or(std::string())))
      out.rows.push_back({cell(row, "t_s"), {axes(row, "f_", "_N"), axes(row, "m_", "_Nm")}});
  return out;
}

}  // namespace

FileAsWritten asWritten(const Scenario& scenario) {
  const toml::table read = toml::parse(std::string_view(scenario.text));
  const std::filesystem::path folder = scenario.file.parent_path();
  FileAsWritten out;
  out.machine = machineOf(read["manipulator"]);
  out.trajectory = trajectoryOf(read["trajectory"], folder);
  if (read["load"]) out.load = loadOf(read["load"], folder);
  return out;
}

}  // namespace ursula
