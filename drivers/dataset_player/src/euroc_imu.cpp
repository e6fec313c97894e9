// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "layouts.hpp"
#include "text_file.hpp"

namespace panvo::dataset_player {

namespace fs = std::filesystem;

std::optional<ImuRecording> read_euroc_imu(const fs::path& folder) {
  if (!fs::exists(folder / "data.csv")) return std::nullopt;
  ImuRecording imu;
  if (fs::exists(folder / "sensor.yaml")) {
    calibration_files::YamlMap sensor(folder / "sensor.yaml", kSensorFile);
    imu.base_from_imu = read_base_from_sensor(sensor);
    const double rate_hz = sensor.number("rate_hz", {0.0, 1e5, "Hz"}, 0.0);
    imu.rate_variance =
        std::pow(sensor.number("gyroscope_noise_density", {0.0, 10.0, "rad/s/sqrt(Hz)"}, 0.0), 2) * rate_hz;
    imu.acceleration_variance =
        std::pow(sensor.number("accelerometer_noise_density", {0.0, 100.0, "m/s^2/sqrt(Hz)"}, 0.0), 2) * rate_hz;
    sensor.check();
  }
  const TextFile file(folder / "data.csv", TextFile::Separator::kComma);
  for (const auto& line : file.lines()) {
    const auto stamp_ns = file.nanoseconds(line, 0);
    if (!imu.samples.empty()) file.expect_later(line, imu.samples.back().stamp_ns, stamp_ns);
    const auto vector = [&](std::size_t field) {
      return Eigen::Vector3d(file.number(line, field), file.number(line, field + 1), file.number(line, field + 2));
    };
    imu.samples.push_back({stamp_ns, vector(1), vector(4)});
  }
  return imu;
}

}  // namespace panvo::dataset_player
