// SPDX-License-Identifier: Apache-2.0
#include "georeference_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <stdexcept>

#include "number_lines.hpp"
#include "panvo/interfaces/check.hpp"

namespace panvo::localizer {
namespace {

constexpr double kHighest_m = 1e5;

Georeference georeference_of(const Lines& lines) {
  Georeference georeference;
  const auto frame = lines.find("map_frame");
  if (frame != lines.end()) georeference.map_frame = frame->second;
  const auto origin = numbers<double>(lines, "origin", 3);
  const auto position = numbers<double>(lines, "position", 3);
  const auto orientation = numbers<double>(lines, "orientation", 4);  // x, y, z, w
  const auto covariance = numbers<double>(lines, "covariance", 36);
  const Eigen::Map<const Eigen::Quaterniond> rotation(orientation.data());
  interfaces::Check check;
  check.within("latitude", origin[0], -90.0, 90.0);
  check.within("longitude", origin[1], -360.0, 360.0);
  check.within("altitude", origin[2], -kHighest_m, kHighest_m);
  check.quaternion("orientation", rotation.x(), rotation.y(), rotation.z(), rotation.w());
  check.bounded("position", position, interfaces::kMaxCoordinate_m);
  check.covariance("covariance", covariance);
  if (check.problem()) throw std::runtime_error(*check.problem());
  georeference.origin = {origin[0], origin[1], origin[2]};
  georeference.map_from_enu.map_from_base = Eigen::Isometry3d(rotation.normalized());
  georeference.map_from_enu.map_from_base.translation() = Eigen::Map<const Eigen::Vector3d>(position.data());
  georeference.map_from_enu.covariance = Eigen::Map<const vision::Matrix6d>(covariance.data());
  return georeference;
}

}  // namespace

void write_georeference(const std::filesystem::path& file, const Georeference& georeference) {
  const auto& [pose, covariance] = georeference.map_from_enu;
  const Eigen::Vector3d position = pose.translation();
  const Eigen::Quaterniond rotation(pose.linear());
  const auto& origin = georeference.origin;
  write_lines(file, fmt::format("map_frame {}\norigin {} {} {}\nposition {} {} {}\norientation {} {} {} {}\n"
                                "covariance {}\n",
                                georeference.map_frame, origin.latitude_deg, origin.longitude_deg, origin.altitude_m,
                                position.x(), position.y(), position.z(), rotation.x(), rotation.y(), rotation.z(),
                                rotation.w(), fmt::join(std::span(covariance.data(), 36), " ")));
}

std::optional<Georeference> read_georeference(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    return georeference_of(read_lines(file));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("{} contains no valid georeference: {}; delete the file, a new one will be "
                    "written",
                    file.string(), error.what()));
  }
}

}  // namespace panvo::localizer
