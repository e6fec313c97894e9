// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_store.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>

#include "landmark_rules.hpp"
#include "panvo/sqlite/database.hpp"
#include "record_bytes.hpp"
#include "store_schema.hpp"

namespace panvo::landmarks {
namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;
using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using PoseNumbers = std::array<double, 7>;

// Bytes of the fields of fixed size: id, stamp, junction, two poses.
constexpr std::int64_t kMostUses = 1'000'000'000;
constexpr std::uint64_t kFixedBytes = 8 + 8 + 1 + 2 * sizeof(PoseNumbers);

PoseNumbers to_numbers(const Eigen::Isometry3d& a_from_b) {
  const Eigen::Vector3d t = a_from_b.translation();
  const Eigen::Quaterniond q = Eigen::Quaterniond(a_from_b.linear()).normalized();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

Eigen::Isometry3d pose_from(const Statement& row, int first_column) {
  const auto number = [&](int i) { return row.real(first_column + i); };
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = Eigen::Quaterniond(number(6), number(3), number(4), number(5)).normalized().toRotationMatrix();
  a_from_b.translation() = Eigen::Vector3d(number(0), number(1), number(2));
  return a_from_b;
}

Bytes covariance_bytes(const Eigen::Matrix<double, 6, 6>& covariance) {
  const RowMajor6d values = covariance;
  return to_bytes(std::span<const double>(values.data(), 36));
}

void bind_pose(Statement& statement, int parameter, const Eigen::Isometry3d& a_from_b) {
  for (const double number : to_numbers(a_from_b)) statement.bind(parameter++, number);
}

PanoramicLandmark landmark_from(const Statement& row) {
  PanoramicLandmark landmark;
  if (row.integer(0) < 1 || row.integer(0) > std::numeric_limits<std::uint32_t>::max()) {
    throw std::range_error("its id is not in 1 to 4294967295");
  }
  landmark.id = static_cast<std::uint32_t>(row.integer(0));
  landmark.stamp_ns = row.integer(1);
  landmark.is_junction = row.integer(2) != 0;
  landmark.map_from_base = pose_from(row, 3);
  landmark.base_from_panorama = pose_from(row, 11);
  const auto covariance = doubles_from(row.blob(10));
  auto histogram = floats_from(row.blob(18));
  auto large = features_from(row.blob(19));
  auto small = features_from(row.blob(20));
  if (!covariance || covariance->size() != 36 || !histogram || !large || !small) {
    throw std::range_error("contains invalid values");
  }
  landmark.covariance = Eigen::Map<const RowMajor6d>(covariance->data());
  landmark.description = {std::move(*histogram), std::move(*large), std::move(*small)};
  return landmark;
}

std::int64_t single_number(const Database& database, const char* sql) {
  Statement statement(database, sql);
  return statement.step() ? statement.integer(0) : 0;
}

Statement all_rows(const Database& database, const std::string& table) {
  return {database, "SELECT * FROM " + table + " ORDER BY 1"};
}

std::string insert_row(const std::string& table, int columns) {
  std::string sql = "INSERT INTO " + table + " VALUES(?";
  for (int column = 1; column < columns; ++column) sql += ",?";
  return sql + ")";
}

void write_use(const Database& database, std::int64_t id, const LandmarkUse& use) {
  Statement row(
      database,
      "INSERT OR REPLACE INTO landmark_use(landmark_id, passes, recognitions, missed, missed_in_company, session) "
      "VALUES(?,?,?,?,?,?)");
  row.bind(1, id).bind(2, std::int64_t{use.passes}).bind(3, std::int64_t{use.recognitions});
  row.bind(4, std::int64_t{use.missed}).bind(5, std::int64_t{use.missed_in_company});
  row.bind(6, std::int64_t{use.session}).run();
}

std::uint32_t next_id(const Database& database) {
  const auto last = single_number(database, "SELECT coalesce(max(id), 0) FROM landmark");
  if (last >= std::numeric_limits<std::uint32_t>::max()) throw StoreError("the store has no ids left");
  return static_cast<std::uint32_t>(last + 1);
}

}  // namespace

template <class Action>
decltype(auto) LandmarkStore::guarded(Action action) const {
  try {
    return action();
  } catch (const sqlite::DatabaseError& error) {
    throw StoreError(explain(file_, error, database_.get()));
  } catch (const std::range_error& error) {
    throw StoreError(file_.string() + ": is damaged: " + error.what() + "; restore a copy");
  }
}

LandmarkStore::LandmarkStore(const std::filesystem::path& file) : file_(file), database_(open_to_read(file)) {
  guarded([this] {
    check_layout(file_, *database_);
    read_settings();
  });
}

LandmarkStore::LandmarkStore(const std::filesystem::path& file, const DescriptionSettings& settings)
    : file_(file), database_(open_to_write(file)) {
  guarded([&] {
    prepare(settings);
    check_layout(file_, *database_);
    read_settings();
  });
  require(settings);
}

LandmarkStore::~LandmarkStore() = default;

void LandmarkStore::prepare(const DescriptionSettings& settings) {
  if (!has_no_tables(*database_)) return;
  Transaction transaction(*database_);
  if (!has_no_tables(*database_)) return;  // another process was faster
  make_tables(*database_);
  Statement insert(*database_, "INSERT INTO meta(key, value) VALUES(?, ?)");
  for (const auto& [key, value] : settings) insert.bind(1, key).bind(2, value).run();
  transaction.commit();
}

void LandmarkStore::read_settings() {
  Statement rows(*database_, "SELECT key, value FROM meta");
  while (rows.step()) settings_.insert_or_assign(rows.text(0), rows.text(1));
}

void LandmarkStore::require(const DescriptionSettings& settings) const {
  const auto found = differences(settings_, settings);
  if (found.empty()) return;
  std::string sentence = file_.string() + ": its landmarks were described with other settings: ";
  for (std::size_t i = 0; i < found.size(); ++i) sentence += (i == 0 ? "" : "; ") + found[i];
  throw StoreError(sentence + ". Use the settings of the store, or another file");
}

std::uint32_t LandmarkStore::add(const PanoramicLandmark& landmark) {
  if (const auto problem = problem_of(landmark, settings_)) {
    throw std::invalid_argument("landmark " + std::to_string(landmark.id) + ": " + *problem);
  }
  return guarded([&] {
    Transaction transaction(*database_);
    const auto id = insert(landmark);
    transaction.commit();
    return id;
  });
}

std::uint32_t LandmarkStore::insert(const PanoramicLandmark& landmark) {
  const std::uint32_t id = landmark.id != 0 ? landmark.id : next_id(*database_);
  Statement taken(*database_, "SELECT 1 FROM landmark WHERE id = ?");
  if (taken.bind(1, std::int64_t{id}).step()) {
    throw StoreError(file_.string() + ": already contains landmark " + std::to_string(id) +
                     "; is another process writing to it? Use one file per run");
  }
  const auto& description = landmark.description;
  const auto covariance = covariance_bytes(landmark.covariance);
  const auto histogram = to_bytes(std::span(description.histogram));
  const auto large = to_bytes(std::span(description.large));
  const auto small = to_bytes(std::span(description.small));
  const auto keypoints = to_bytes(std::span(landmark.keypoints));
  Statement row(*database_, "INSERT INTO landmark VALUES(?,?,?, ?,?,?,?,?,?,?, ?, ?,?,?,?,?,?,?, ?,?,?)");
  row.bind(1, std::int64_t{id}).bind(2, landmark.stamp_ns).bind(3, std::int64_t{landmark.is_junction});
  bind_pose(row, 4, landmark.map_from_base);
  row.bind(11, covariance);
  bind_pose(row, 12, landmark.base_from_panorama);
  row.bind(19, histogram).bind(20, large).bind(21, small).run();
  Statement(*database_, "INSERT INTO keypoints VALUES(?, ?, ?)")
      .bind(1, std::int64_t{id})
      .bind(2, static_cast<std::int64_t>(landmark.keypoints.size()))
      .bind(3, keypoints)
      .run();
  Statement(*database_, "INSERT INTO thumbnail VALUES(?, ?)")
      .bind(1, std::int64_t{id})
      .bind(2, landmark.thumbnail)
      .run();
  return id;
}

void LandmarkStore::set_poses(std::span<const LandmarkPose> poses) {
  for (const auto& pose : poses) {
    if (const auto problem = problem_of_pose(pose.map_from_base, pose.covariance)) {
      throw std::invalid_argument("landmark " + std::to_string(pose.id) + ": " + *problem);
    }
  }
  guarded([&] {
    Transaction transaction(*database_);
    Statement update(*database_, "UPDATE landmark SET x=?, y=?, z=?, qx=?, qy=?, qz=?, qw=?, covariance=? WHERE id=?");
    for (const auto& pose : poses) {
      const auto covariance = covariance_bytes(pose.covariance);
      bind_pose(update, 1, pose.map_from_base);
      update.bind(8, covariance).bind(9, std::int64_t{pose.id}).run();
    }
    transaction.commit();
  });
}

void LandmarkStore::remove(std::span<const std::uint32_t> ids) {
  guarded([&] {
    Transaction transaction(*database_);
    const auto remove_from = [&](const std::string& table, const std::string& column) {
      Statement statement(*database_, "DELETE FROM " + table + " WHERE " + column + " = ?");
      for (const auto id : ids) statement.bind(1, std::int64_t{id}).run();
    };
    remove_from("landmark", "id");
    remove_from("keypoints", "landmark_id");
    remove_from("thumbnail", "landmark_id");
    if (has_uses()) remove_from("landmark_use", "landmark_id");
    transaction.commit();
  });
}

bool LandmarkStore::has_uses() const {
  return single_number(*database_, "SELECT count(*) FROM sqlite_master WHERE type='table' AND name='landmark_use'") > 0;
}

void LandmarkStore::set_uses(const std::map<std::uint32_t, LandmarkUse>& uses) {
  guarded([&] {
    Transaction transaction(*database_);
    make_table_of_uses(*database_);
    Statement known(*database_, "SELECT 1 FROM landmark WHERE id = ?");
    for (const auto& [id, use] : uses) {
      const bool is_known = known.bind(1, std::int64_t{id}).step();
      known.reset();
      if (is_known) write_use(*database_, id, use);
    }
    transaction.commit();
  });
}

std::map<std::uint32_t, LandmarkUse> LandmarkStore::uses() const {
  return guarded([&] {
    std::map<std::uint32_t, LandmarkUse> uses;
    if (!has_uses()) return uses;
    Statement rows(*database_, "SELECT * FROM landmark_use");
    const bool has_sessions = rows.columns() > 5;  // the first version of the table had none
    while (rows.step()) {
      const auto number = [&](int column) {
        return static_cast<std::uint32_t>(std::clamp<std::int64_t>(rows.integer(column), 0, kMostUses));
      };
      uses[static_cast<std::uint32_t>(rows.integer(0))] = {has_sessions ? number(5) : 0, number(1), number(2),
                                                           number(3), number(4)};
    }
    return uses;
  });
}

std::uint32_t LandmarkStore::append(const LandmarkStore& other) {
  require(other.settings());
  return guarded([&] {
    Transaction transaction(*database_);
    const auto first = next_id(*database_);
    std::map<std::int64_t, std::int64_t> new_ids;
    for (const char* table : {"landmark", "keypoints", "thumbnail"}) {  // first column of each: landmark id
      auto rows = other.guarded([&] { return all_rows(*other.database_, table); });
      Statement insert(*database_, insert_row(table, rows.columns()));
      while (other.guarded([&] { return rows.step(); })) {
        const auto id = new_ids.try_emplace(rows.integer(0), first + static_cast<std::int64_t>(new_ids.size())).first;
        insert.bind(1, id->second);
        for (int column = 1; column < rows.columns(); ++column) insert.bind(column + 1, rows, column);
        insert.run();
      }
    }
    append_uses(other, new_ids);
    transaction.commit();
    return first;
  });
}

void LandmarkStore::append_uses(const LandmarkStore& other, const std::map<std::int64_t, std::int64_t>& new_ids) {
  make_table_of_uses(*database_);
  const auto first_session = next_session();
  auto uses = other.uses();
  for (const auto& [old_id, new_id] : new_ids) {
    auto use = uses[static_cast<std::uint32_t>(old_id)];
    use.session += first_session;
    write_use(*database_, new_id, use);
  }
}

std::uint32_t LandmarkStore::next_session() const {
  std::uint32_t last = 0;
  for (const auto& [id, use] : uses()) last = std::max(last, use.session);
  return last + 1;
}

std::size_t LandmarkStore::size() const {
  return guarded([&] { return static_cast<std::size_t>(single_number(*database_, "SELECT count(*) FROM landmark")); });
}

std::vector<PanoramicLandmark> LandmarkStore::landmarks(const std::function<void(const std::string&)>& report) const {
  return guarded([&] {
    std::vector<PanoramicLandmark> landmarks;
    Statement rows(*database_, "SELECT * FROM landmark ORDER BY id");
    while (rows.step()) {
      std::optional<std::string> problem;
      try {
        auto landmark = landmark_from(rows);
        problem = problem_of(landmark, settings_);
        if (!problem) landmarks.push_back(std::move(landmark));
      } catch (const std::range_error& error) {
        problem = error.what();
      }
      if (problem && report) report("landmark " + std::to_string(rows.integer(0)) + ": " + *problem);
    }
    return landmarks;
  });
}

std::vector<Keypoint> LandmarkStore::keypoints(std::uint32_t id) const {
  return guarded([&]() -> std::vector<Keypoint> {
    Statement row(*database_, "SELECT data FROM keypoints WHERE landmark_id = ?");
    if (!row.bind(1, std::int64_t{id}).step()) return {};
    auto keypoints = keypoints_from(row.blob(0));
    const auto problem = keypoints ? problem_of(*keypoints) : "keypoints are truncated or not finite";
    if (problem) throw std::range_error("landmark " + std::to_string(id) + ": " + *problem);
    return std::move(*keypoints);
  });
}

std::vector<std::uint8_t> LandmarkStore::thumbnail(std::uint32_t id) const {
  return guarded([&]() -> std::vector<std::uint8_t> {
    Statement row(*database_, "SELECT jpeg FROM thumbnail WHERE landmark_id = ?");
    if (!row.bind(1, std::int64_t{id}).step()) return {};
    const auto bytes = row.blob(0);
    return {bytes.begin(), bytes.end()};
  });
}

std::uint64_t LandmarkStore::keypoint_count() const {
  return guarded([&] {
    return static_cast<std::uint64_t>(single_number(*database_, "SELECT coalesce(sum(count), 0) FROM keypoints"));
  });
}

StoredBytes LandmarkStore::stored_bytes() const {
  return guarded([&] {
    const auto sum = [&](const std::string& column, const char* table) {
      const auto sql = "SELECT coalesce(sum(length(" + column + ")), 0) FROM " + table;
      return static_cast<std::uint64_t>(single_number(*database_, sql.c_str()));
    };
    StoredBytes bytes;
    bytes.pose = sum("covariance", "landmark") + kFixedBytes * size();
    bytes.histogram = sum("histogram", "landmark");
    bytes.large = sum("large_features", "landmark");
    bytes.small = sum("small_features", "landmark");
    bytes.keypoints = sum("data", "keypoints");
    bytes.thumbnail = sum("jpeg", "thumbnail");
    bytes.file = static_cast<std::uint64_t>(single_number(*database_, "PRAGMA page_count") *
                                            single_number(*database_, "PRAGMA page_size"));
    return bytes;
  });
}

std::optional<std::string> LandmarkStore::find_damage() const {
  return guarded([&]() -> std::optional<std::string> {
    auto damage = damage_of(*database_);
    if (!damage.empty()) return damage;  // records of a corrupt page cannot be checked
    constexpr int kMaxTold = 3;
    int found = 0;
    const auto tell = [&](const std::string& problem) {
      if (++found <= kMaxTold) damage += (damage.empty() ? "" : "; ") + problem;
    };
    for (const auto& landmark : landmarks(tell)) {
      try {
        keypoints(landmark.id);
      } catch (const StoreError& error) {
        tell(error.what());
      }
    }
    if (found > kMaxTold) damage += "; and " + std::to_string(found - kMaxTold) + " more";
    return damage.empty() ? std::nullopt : std::optional(std::move(damage));
  });
}

}  // namespace panvo::landmarks
