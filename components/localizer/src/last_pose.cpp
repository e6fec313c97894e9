// SPDX-License-Identifier: Apache-2.0
#include "last_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <system_error>

namespace panvo::localizer {
namespace {

using Json = nlohmann::json;

constexpr double kSlowest_m_per_s = 0.5;  // who stands may start
constexpr double kClimb = 0.1;            // of the way, up or down
constexpr double kTurn_rad_per_s = 0.3;   // of a vehicle in a bend
constexpr double kTilt_rad = 0.05;

std::runtime_error unusable(const std::filesystem::path& file, const std::string& why) {
  return std::runtime_error(fmt::format("{}: {}; delete it, and the next one is written", file.string(), why));
}

template <std::size_t kSize>
std::array<double, kSize> numbers(const Json& json, const char* key) {
  const auto values = json.at(key).get<std::array<double, kSize>>();
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
    throw std::runtime_error(fmt::format("'{}' has a number that is none", key));
  }
  return values;
}

LastPose from_json(const Json& json) {
  LastPose last;
  json.at("stamp_ns").get_to(last.stamp_ns);
  json.at("map_frame").get_to(last.map_frame);
  json.at("speed_m_per_s").get_to(last.speed_m_per_s);
  const auto position = numbers<3>(json, "position");
  const auto orientation = numbers<4>(json, "orientation");  // x, y, z, w
  const auto covariance = numbers<36>(json, "covariance");
  const Eigen::Map<const Eigen::Quaterniond> rotation(orientation.data());
  if (std::abs(rotation.norm() - 1.0) > 1e-3) throw std::runtime_error("'orientation' is not of length 1");
  last.pose.map_from_base = Eigen::Isometry3d(rotation.normalized());
  last.pose.map_from_base.translation() = Eigen::Map<const Eigen::Vector3d>(position.data());
  last.pose.covariance = Eigen::Map<const vision::Matrix6d>(covariance.data());
  return last;
}

Json to_json(const LastPose& last) {
  const Eigen::Vector3d position = last.pose.map_from_base.translation();
  const Eigen::Quaterniond rotation(last.pose.map_from_base.linear());
  std::array<double, 36> covariance{};
  Eigen::Map<vision::Matrix6d>(covariance.data()) = last.pose.covariance;
  return {{"stamp_ns", last.stamp_ns},
          {"map_frame", last.map_frame},
          {"position", {position.x(), position.y(), position.z()}},
          {"orientation", {rotation.x(), rotation.y(), rotation.z(), rotation.w()}},
          {"speed_m_per_s", last.speed_m_per_s},
          {"covariance", covariance}};
}

}  // namespace

PoseInMap after_gap(const LastPose& last, double gap_s) {
  const double way_m = std::max(last.speed_m_per_s, kSlowest_m_per_s) * gap_s;
  const double turn_rad = std::min(kTurn_rad_per_s * gap_s, std::numbers::pi);
  vision::Vector6d sigma;
  sigma << way_m, way_m, kClimb * way_m, kTilt_rad, kTilt_rad, turn_rad;
  PoseInMap now = last.pose;
  now.covariance.diagonal() += sigma.cwiseAbs2();
  return now;
}

void write_last_pose(const std::filesystem::path& file, const LastPose& last) {
  std::filesystem::path part = file;
  part += ".part";
  std::ofstream stream(part);
  stream << to_json(last).dump(1) << '\n';
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(part, file, error);
  if (!stream || error) {
    throw std::runtime_error(
        fmt::format("cannot write {}: name a file in a folder that is there and can be written to, with space left",
                    file.string()));
  }
}

std::optional<LastPose> read_last_pose(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    std::ifstream stream(file);
    return from_json(Json::parse(stream));
  } catch (const Json::exception& error) {
    throw unusable(file, fmt::format("no pose is in it ({})", error.what()));
  } catch (const std::runtime_error& error) {
    throw unusable(file, error.what());
  }
}

}  // namespace panvo::localizer
