// SPDX-License-Identifier: Apache-2.0
#include "store_info.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "panvo/landmarks/landmark_library.hpp"
#include "print.hpp"

namespace panvo::landmarks {
namespace {

/// The parts of a landmark in the order of the report, with their JSON keys.
std::vector<std::pair<const char*, std::uint64_t>> parts(const StoredBytes& bytes) {
  const auto sum = bytes.pose + bytes.histogram + bytes.large + bytes.small + bytes.keypoints + bytes.thumbnail;
  return {{"pose", bytes.pose},
          {"histogram", bytes.histogram},
          {"large", bytes.large},
          {"small", bytes.small},
          {"keypoints", bytes.keypoints},
          {"thumbnail", bytes.thumbnail},
          {"structure", bytes.file > sum ? bytes.file - sum : 0}};
}

double each(std::uint64_t total, std::size_t landmarks) {
  return landmarks == 0 ? 0.0 : static_cast<double>(total) / static_cast<double>(landmarks);
}

std::string seconds(std::int64_t stamp_ns) {
  return print("%lld.%09lld", static_cast<long long>(stamp_ns / 1'000'000'000),
               static_cast<long long>(stamp_ns % 1'000'000'000));
}

}  // namespace

StoreInfo inspect(const LandmarkStore& store, double close_m, bool look_for_damage) {
  StoreInfo info;
  info.file = store.name();
  if (look_for_damage) info.damage = store.find_damage();
  if (info.damage) return info;
  LandmarkLibrary library;
  for (auto& landmark : store.landmarks()) library.add(std::move(landmark));
  info.landmarks = library.size();
  info.keypoints = store.keypoint_count();
  info.bytes = store.stored_bytes();
  info.settings = store.settings();
  for (const auto& [id, use] : store.uses()) {
    info.passes += use.passes;
    info.recognitions += use.recognitions;
    info.missed += use.missed > 0;
  }
  for (const auto* landmark : library.all()) {
    const Eigen::Vector3d position = landmark->map_from_base.translation();
    if (landmark == library.all().front()) {
      info.smallest = info.largest = position.head<2>();
      info.first_stamp_ns = info.last_stamp_ns = landmark->stamp_ns;
    }
    info.junctions += landmark->is_junction;
    info.features_large += landmark->description.large.size();
    info.features_small += landmark->description.small.size();
    info.smallest = info.smallest.cwiseMin(position.head<2>());
    info.largest = info.largest.cwiseMax(position.head<2>());
    info.first_stamp_ns = std::min(info.first_stamp_ns, landmark->stamp_ns);
    info.last_stamp_ns = std::max(info.last_stamp_ns, landmark->stamp_ns);
    for (const auto* other : library.within(position, close_m)) {
      if (other->id <= landmark->id) continue;
      const double distance = (other->map_from_base.translation() - position).head<2>().norm();
      info.close.push_back({landmark->id, other->id, distance});
    }
  }
  return info;
}

std::string describe_as_text(const StoreInfo& info) {
  std::string text;
  const auto line = [&](std::string label, const std::string& value) {
    label.resize(15, ' ');
    text += label + value + "\n";
  };
  line("Store:", info.file);
  if (info.damage) {
    line("Damaged:", *info.damage);
    return text;
  }
  line("Landmarks:", print("%zu, %zu of them road junctions", info.landmarks, info.junctions));
  if (info.landmarks > 0) {
    line("Extent:", print("x %.1f to %.1f m, y %.1f to %.1f m", info.smallest.x(), info.largest.x(), info.smallest.y(),
                          info.largest.y()));
    line("First, last:", seconds(info.first_stamp_ns) + ", " + seconds(info.last_stamp_ns));
    line("Per landmark:", print("%.0f large features, %.0f small, %.0f keypoints; %.1f kB of the file's %.3f MB",
                                each(info.features_large, info.landmarks), each(info.features_small, info.landmarks),
                                each(info.keypoints, info.landmarks), each(info.bytes.file, info.landmarks) / 1000.0,
                                static_cast<double>(info.bytes.file) / 1e6));
    for (const auto& [name, bytes] : parts(info.bytes)) {
      line("", print("%-10s %8.0f bytes", name, each(bytes, info.landmarks)));
    }
  }
  if (info.passes > 0) {
    line("Use:", print("passed %llu times, recognised %llu times; %zu landmarks missed on their last pass",
                       static_cast<unsigned long long>(info.passes), static_cast<unsigned long long>(info.recognitions),
                       info.missed));
  }
  std::string label = "Settings:";
  for (const auto& [key, value] : info.settings) {
    line(std::exchange(label, ""), key + " = " + value);
  }
  label = "Close pairs:";
  for (const auto& pair : info.close) {
    line(std::exchange(label, ""),
         print("landmarks %u and %u are %.2f m apart", pair.first, pair.second, pair.distance_m));
  }
  return text;
}

std::string describe_as_json(const StoreInfo& info) {
  nlohmann::ordered_json json;
  json["store"] = info.file;
  json["damage"] = info.damage ? nlohmann::ordered_json(*info.damage) : nlohmann::ordered_json();
  json["landmarks"] = info.landmarks;
  json["junctions"] = info.junctions;
  json["keypoints"] = info.keypoints;
  json["features_large"] = info.features_large;
  json["features_small"] = info.features_small;
  json["file_bytes"] = info.bytes.file;
  json["bytes_per_landmark"]["all"] = each(info.bytes.file, info.landmarks);
  for (const auto& [name, bytes] : parts(info.bytes)) json["bytes_per_landmark"][name] = each(bytes, info.landmarks);
  const bool empty = info.landmarks == 0;
  const auto or_null = [&](const auto& value) {
    return empty ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
  };
  json["extent"]["x_m"] = or_null(std::array{info.smallest.x(), info.largest.x()});
  json["extent"]["y_m"] = or_null(std::array{info.smallest.y(), info.largest.y()});
  json["first_stamp_ns"] = or_null(info.first_stamp_ns);
  json["last_stamp_ns"] = or_null(info.last_stamp_ns);
  json["use"] = {{"passes", info.passes}, {"recognitions", info.recognitions}, {"missed", info.missed}};
  json["settings"] = info.settings;
  json["close"] = nlohmann::ordered_json::array();
  for (const auto& pair : info.close) {
    json["close"].push_back({{"first", pair.first}, {"second", pair.second}, {"distance_m", pair.distance_m}});
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace panvo::landmarks
