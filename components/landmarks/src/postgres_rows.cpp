// SPDX-License-Identifier: Apache-2.0
#include "postgres_rows.hpp"
#include "panvo/interfaces/place_rules.hpp"

namespace panvo::landmarks {
namespace {

PoseNumbers pose_in(const postgres::Result& rows, int row, int first_column) {
  PoseNumbers numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = rows.real(row, first_column + static_cast<int>(i));
  return numbers;
}

}  // namespace

Bytes bytes_in(const postgres::Result& rows, int row, int column) {
  const auto bytes = rows.bytes(row, column);
  return {bytes.begin(), bytes.end()};
}

const char* const kSelectDescriptions =
    "SELECT id, stamp_ns, is_junction, x, y, z, qx, qy, qz, qw, covariance, panorama_x, panorama_y, panorama_z, "
    "panorama_qx, panorama_qy, panorama_qz, panorama_qw, histogram, large_features, small_features "
    "FROM panvo.landmark WHERE id > $1 ORDER BY id LIMIT $2";
const char* const kSelectWholeLandmarks =
    "SELECT id, stamp_ns, is_junction, x, y, z, qx, qy, qz, qw, covariance, panorama_x, panorama_y, panorama_z, "
    "panorama_qx, panorama_qy, panorama_qz, panorama_qw, histogram, large_features, small_features, "
    "coalesce(k.count, 0), coalesce(k.data, ''), coalesce(t.jpeg, '') FROM panvo.landmark "
    "LEFT JOIN panvo.keypoints AS k ON k.landmark_id = id LEFT JOIN panvo.thumbnail AS t ON t.landmark_id = id "
    "WHERE id > $1 ORDER BY id LIMIT $2";

const std::string kSelectLastId = "SELECT greatest(last_id, (SELECT max(id) FROM panvo.landmark WHERE id <= " +
                                  std::to_string(interfaces::kMaxLandmarkId) + ")) FROM panvo.store";

std::map<std::uint32_t, LandmarkUse> uses_in(const postgres::Result& rows) {
  std::map<std::uint32_t, LandmarkUse> uses;
  for (int i = 0; i < rows.rows(); ++i) {
    const auto column = [&](int j) { return use_number(rows.integer(i, j)); };
    uses[static_cast<std::uint32_t>(rows.integer(i, 0))] = {column(1), column(2), column(3), column(4), column(5)};
  }
  return uses;
}

StoredLandmark landmark_in(const postgres::Result& rows, int row, bool is_whole) {
  StoredLandmark landmark;
  landmark.id = rows.integer(row, 0);
  landmark.stamp_ns = rows.integer(row, 1);
  landmark.is_junction = rows.integer(row, 2);
  landmark.map_from_base = pose_in(rows, row, 3);
  landmark.covariance = bytes_in(rows, row, 10);
  landmark.base_from_panorama = pose_in(rows, row, 11);
  landmark.histogram = bytes_in(rows, row, 18);
  landmark.large = bytes_in(rows, row, 19);
  landmark.small = bytes_in(rows, row, 20);
  if (!is_whole) return landmark;
  landmark.keypoint_count = rows.integer(row, 21);
  landmark.keypoints = bytes_in(rows, row, 22);
  landmark.thumbnail = bytes_in(rows, row, 23);
  return landmark;
}

std::vector<postgres::Value> columns_of(const StoredLandmark& landmark) {
  std::vector<postgres::Value> values{landmark.id, landmark.stamp_ns, landmark.is_junction};
  values.insert(values.end(), landmark.map_from_base.begin(), landmark.map_from_base.end());
  values.emplace_back(std::span(landmark.covariance));
  values.insert(values.end(), landmark.base_from_panorama.begin(), landmark.base_from_panorama.end());
  for (const auto* bytes : {&landmark.histogram, &landmark.large, &landmark.small}) {
    values.emplace_back(std::span(*bytes));
  }
  return values;
}

}  // namespace panvo::landmarks
