// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/place_library.hpp"

#include <unistd.h>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/sqlite/database.hpp"

namespace panvo::places {
namespace {

namespace fs = std::filesystem;
using landmarks::LandmarkStore;
using landmarks::StoreError;

constexpr std::uint64_t kSeed = 1;
const cv::Size kThumbnail(540, 270);
constexpr const char* kTable =
    "CREATE TABLE place(landmark_id INTEGER PRIMARY KEY, name TEXT NOT NULL, has_pose INTEGER NOT NULL)";

landmarks::DescriptionSettings settings() {
  return landmarks::description_settings(landmarks::DescriptionParameters{}, kSeed);
}

struct Named {
  std::string name;
  bool has_pose = false;
};

std::map<std::uint32_t, Named> read_names(const fs::path& file) {
  std::map<std::uint32_t, Named> names;
  try {
    const sqlite::Database database(file, sqlite::Database::Mode::kRead);
    sqlite::Statement statement(database, "SELECT landmark_id, name, has_pose FROM place");
    while (statement.step()) {
      names[static_cast<std::uint32_t>(statement.integer(0))] = {statement.text(1), statement.integer(2) != 0};
    }
  } catch (const sqlite::DatabaseError&) {
    throw StoreError(file.string() + ": holds no names of places; make it with `panvo places build`");
  }
  return names;
}

void write_names(const fs::path& file, const std::vector<KnownPlace>& places) {
  try {
    sqlite::Database database(file, sqlite::Database::Mode::kReadWrite);
    sqlite::Transaction transaction(database);
    database.execute(kTable);
    sqlite::Statement insert(database, "INSERT INTO place VALUES(?, ?, ?)");
    for (std::size_t i = 0; i < places.size(); ++i) {
      insert.bind(1, static_cast<std::int64_t>(i + 1)).bind(2, std::string_view(places[i].name));
      insert.bind(3, static_cast<std::int64_t>(places[i].map_from_base ? 1 : 0)).run();
    }
    transaction.commit();
  } catch (const sqlite::DatabaseError& error) {
    throw StoreError(file.string() + ": cannot be written (" + error.what() + "); free disk space");
  }
}

}  // namespace

landmarks::KeypointParameters place_keypoints() {
  landmarks::KeypointParameters parameters;
  parameters.most = 800;
  parameters.half_size = false;
  parameters.top_deg = 55.0;
  parameters.bottom_deg = 45.0;
  parameters.min_contrast = 0.01;
  return parameters;
}

const landmarks::PanoramaDescriber& place_describer() {
  static const landmarks::PanoramaDescriber describer({}, kSeed);
  return describer;
}

KnownPlace make_place(const std::string& name, const PanoramaImage& image) {
  KnownPlace place;
  place.name = name;
  place.description = place_describer().describe(image.grey);
  place.keypoints = detect_keypoints(image.grey, place_keypoints(), image.seen);
  cv::Mat small;
  cv::resize(image.grey, small, kThumbnail, 0.0, 0.0, cv::INTER_AREA);
  cv::imencode(".jpg", small, place.thumbnail);
  return place;
}

void save_places(const fs::path& file, const std::vector<KnownPlace>& places) {
  const fs::path partial = file.string() + "." + std::to_string(::getpid()) + ".partial";
  fs::remove(partial);
  try {
    {
      LandmarkStore store(partial, settings());
      for (const auto& place : places) {
        landmarks::PanoramicLandmark landmark;
        landmark.map_from_base = place.map_from_base.value_or(Eigen::Isometry3d::Identity());
        landmark.description = place.description;
        landmark.keypoints = place.keypoints;
        landmark.thumbnail = place.thumbnail;
        store.add(landmark);
      }
    }
    write_names(partial, places);
    fs::rename(partial, file);
  } catch (...) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw;
  }
}

std::vector<KnownPlace> load_places(const fs::path& file) {
  const LandmarkStore store(file);
  store.require(settings());
  const auto names = read_names(file);
  std::vector<KnownPlace> places;
  for (auto& landmark : store.landmarks()) {
    const auto named = names.find(landmark.id);
    if (named == names.end()) continue;
    KnownPlace& place = places.emplace_back();
    place.name = named->second.name;
    if (named->second.has_pose) place.map_from_base = landmark.map_from_base;
    place.description = std::move(landmark.description);
    place.keypoints = store.keypoints(landmark.id);
    place.thumbnail = store.thumbnail(landmark.id);
  }
  return places;
}

}  // namespace panvo::places
