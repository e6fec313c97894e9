// SPDX-License-Identifier: Apache-2.0
// The gyroscope of EuRoC V1_02 against its Vicon-based truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include "panvo/odometry_fusion/factors.hpp"
#include "panvo/odometry_fusion/sample_window.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::odometry_fusion {
namespace {

using Row = std::vector<double>;

struct Table {
  std::vector<std::int64_t> stamps_ns;
  std::vector<Row> rows;
};

Table read(const std::filesystem::path& file) {
  Table table;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::int64_t stamp_ns = 0;
    words >> stamp_ns;
    table.stamps_ns.push_back(stamp_ns);
    table.rows.emplace_back(std::istream_iterator<double>(words), std::istream_iterator<double>());
  }
  return table;
}

Eigen::Matrix3d rotation(const Row& truth) {
  return Eigen::Quaterniond(truth[3], truth[4], truth[5], truth[6]).normalized().toRotationMatrix();
}

TEST(RealGyroscope, FollowsTheTruthFor35SecondsWithItsBias) {
  const auto folder = panvo::test::recorded_data("euroc_v102_imu");
  PANVO_NEEDS_RECORDING(folder);
  const Table imu = read(folder / "imu0" / "data.csv"), truth = read(folder / "gt0" / "data.csv");
  SampleWindow<GyroSample> window(0.05);
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  for (const auto& row : truth.rows)
    bias += Eigen::Vector3d(row[10], row[11], row[12]) / static_cast<double>(truth.rows.size());
  MotionFilter filter{FusionParameters{}};
  LearnedVector learned = LearnedVector::Zero();
  learned.segment<3>(kGyroBias) = bias;
  filter.restart(0, kLearned, learned, LearnedVector::Constant(1e-9));
  // 20 intervals a second, as with a camera.
  const std::int64_t begin_ns = truth.stamps_ns.front();
  std::size_t next = 0;
  int compared = 0;
  double worst_rad = 0.0;
  for (std::int64_t from_ns = begin_ns; from_ns < begin_ns + 35'000'000'000; from_ns += 50'000'000) {
    const std::int64_t to_ns = from_ns + 50'000'000;
    while (next < imu.rows.size() && imu.stamps_ns[next] <= to_ns + 5'000'000) {
      window.add(GyroSample{imu.stamps_ns[next], Eigen::Vector3d(imu.rows[next].data()), 0.0});
      ++next;
    }
    const auto samples = window.span(from_ns, to_ns);
    ASSERT_FALSE(samples.empty());
    filter.begin_unknown(0.05);
    filter.update(gyro_factor(filter, samples, {}));
    filter.compose();
    window.forget_before(from_ns);
    const auto at = std::ranges::find(truth.stamps_ns, to_ns);
    if (at == truth.stamps_ns.end()) continue;
    ++compared;
    const Eigen::Matrix3d true_turn = rotation(truth.rows.front()).transpose() *
                                      rotation(truth.rows[static_cast<std::size_t>(at - truth.stamps_ns.begin())]);
    worst_rad = std::max(worst_rad, vision::so3_log(filter.odom_from_base().linear().transpose() * true_turn).norm());
  }
  EXPECT_GT(compared, 600);
  EXPECT_LT(worst_rad * 180.0 / M_PI, 0.3);
}

}  // namespace
}  // namespace panvo::odometry_fusion
