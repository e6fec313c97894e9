// SPDX-License-Identifier: Apache-2.0
#include "rig_settings.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include "panvo/simulated_world/site.hpp"

namespace panvo::simulation {
namespace {

/// One group of a rig file (`stereo`, `panorama`): reads its values, and records problems and the keys that were read.
class Group {
 public:
  Group(std::string file, const std::string& name, YAML::Node node, std::string& problems)
      : file_(std::move(file)), name_(name), node_(std::move(node)), problems_(problems) {
    if (node_ && !node_.IsMap()) {
      report(node_, "", "must be a map of settings");
      node_ = {};
    }
  }

  bool has(const char* key) const { return node_ && node_[key]; }

  void number(const char* key, double& value, double low, double high, const char* unit) {
    read(key, fmt::format("must be a number from {} to {} {}", low, high, unit), [&](const YAML::Node& node) {
      value = node.as<double>();
      return value >= low && value <= high;
    });
  }

  void size(const char* key, int& width, int& height) {
    read(key, "must be [width, height], from 16 to 8192 px", [&](const YAML::Node& node) {
      if (node.size() != 2) return false;
      width = node[0].as<int>();
      height = node[1].as<int>();
      return width >= 16 && width <= 8192 && height >= 16 && height <= 8192;
    });
  }

  template <class Values>
  void numbers(const char* key, Values& values, std::size_t count, double limit, const char* unit) {
    read(key, fmt::format("must be a list of {} numbers up to {} {}", count, limit, unit), [&](const YAML::Node& node) {
      if (!node.IsSequence() || node.size() != count) return false;
      for (std::size_t i = 0; i < count; ++i) {
        values[static_cast<Eigen::Index>(i)] = node[i].as<double>();
        if (!(std::abs(values[static_cast<Eigen::Index>(i)]) <= limit)) return false;
      }
      return true;
    });
  }

  void flag(const char* key, bool& value) {
    read(key, "must be true or false", [&](const YAML::Node& node) {
      value = node.as<bool>();
      return true;
    });
  }

  template <class Value>
  void choice(const char* key, Value& value, const std::map<std::string, Value>& choices) {
    std::string names;
    for (const auto& [name, meaning] : choices) names += (names.empty() ? "" : ", ") + name;
    read(key, "must be one of " + names, [&](const YAML::Node& node) {
      const auto found = choices.find(node.as<std::string>());
      if (found != choices.end()) value = found->second;
      return found != choices.end();
    });
  }

  void reject(const char* key, const std::string& what) { report(node_ ? node_[key] : YAML::Node(), key, what); }

  /// Reports unknown keys.
  void finish() {
    if (!node_) return;
    std::string known;
    for (const auto& key : asked_) known += (known.empty() ? "" : ", ") + key;
    for (const auto& entry : node_) {
      const auto key = entry.first.as<std::string>();
      if (!asked_.contains(key)) report(entry.first, key, "is not known here; known keys: " + known);
    }
  }

 private:
  template <class Reader>
  void read(const char* key, const std::string& rule, Reader reader) {
    asked_.insert(key);
    if (!has(key)) return;
    const YAML::Node node = node_[key];
    bool is_good = false;
    try {
      is_good = reader(node);
    } catch (const YAML::Exception&) {
      is_good = false;  // wrong type: reported with the rule
    }
    if (!is_good) report(node, key, rule);
  }

  void report(const YAML::Node& node, const std::string& key, const std::string& what) {
    problems_ +=
        fmt::format("{}:{}: {}{}{} {}\n", file_, node.Mark().line + 1, name_, key.empty() ? "" : ".", key, what);
  }

  std::string file_, name_;
  YAML::Node node_;
  std::string& problems_;
  std::set<std::string> asked_;
};

void read_stereo(Group& group, StereoSettings& stereo) {
  group.number("rate_hz", stereo.rate_hz, 0.1, 1000.0, "Hz");
  group.size("size_px", stereo.width, stereo.height);
  group.number("field_of_view_deg", stereo.field_of_view_deg, 5.0, 150.0,
               "degrees (a pinhole camera sees less than 180; use a fisheye for more)");
  group.number("baseline_m", stereo.baseline_m, 0.005, 5.0, "m (the right eye must be to the right of the left one)");
  group.numbers("position_m", stereo.position_m, 3, 10.0, "m");
  group.number("yaw_deg", stereo.yaw_deg, -180.0, 180.0, "degrees");
  group.number("pitch_deg", stereo.pitch_deg, -90.0, 90.0, "degrees");
  group.number("roll_deg", stereo.roll_deg, -180.0, 180.0, "degrees");
  group.numbers("principal_point_offset_px", stereo.principal_point_offset_px, 2, 1000.0, "px");
  group.numbers("distortion", stereo.distortion, 5, 10.0, "(k1 k2 p1 p2 k3)");
  group.numbers("right_rotation_deg", stereo.right_rotation_deg, 3, 10.0, "degrees");
  group.number("exposure_ms", stereo.exposure_ms, 0.0, 100.0, "ms");
  group.flag("colour", stereo.colour);
  group.finish();
}

/// `has_body`: of the vehicle.
void read_panorama(Group& group, PanoramaSettings& panorama, bool has_body) {
  group.choice<PanoramaKind>("kind", panorama.kind,
                             {{"equirectangular", PanoramaKind::kEquirectangular},
                              {"six_head", PanoramaKind::kSixHead},
                              {"dual_fisheye", PanoramaKind::kDualFisheye}});
  if (panorama.kind == PanoramaKind::kSixHead) panorama.width = 616, panorama.height = 808;
  if (panorama.kind == PanoramaKind::kDualFisheye) panorama.width = panorama.height = 960;
  group.number("rate_hz", panorama.rate_hz, 0.1, 1000.0, "Hz");
  group.size("size_px", panorama.width, panorama.height);
  group.numbers("position_m", panorama.position_m, 3, 10.0, "m");
  const double body_m = simulated_world::own_vehicle_height_m(panorama.position_m.x(), panorama.position_m.y());
  if (has_body && panorama.position_m.z() < body_m) {
    group.reject("position_m",
                 fmt::format("is inside the vehicle's body, which is {:.2f} m high there: move the camera, or "
                             "simulate a vehicle without a body (vehicle.has_body: false)",
                             body_m));
  }
  group.number("yaw_deg", panorama.yaw_deg, -180.0, 180.0, "degrees");
  group.number("pitch_deg", panorama.pitch_deg, -90.0, 90.0, "degrees");
  group.number("roll_deg", panorama.roll_deg, -180.0, 180.0, "degrees");
  group.number("head_radius_m", panorama.head_radius_m, 0.0, 1.0, "m");
  group.number("exposure_ms", panorama.exposure_ms, 0.0, 200.0, "ms");
  group.flag("colour", panorama.colour);
  if (panorama.kind == PanoramaKind::kEquirectangular && panorama.width != 2 * panorama.height) {
    group.reject("size_px", "of an equirectangular panorama must be twice as wide as high");
  }
  group.finish();
}

}  // namespace

RigSettings read_rig_settings(const std::filesystem::path& file) {
  YAML::Node root;
  try {
    root = YAML::LoadFile(file.string());
  } catch (const YAML::BadFile&) {
    throw std::runtime_error(file.string() + ": cannot be read; use a rig file such as config/rigs/paper/rig.yaml");
  } catch (const YAML::ParserException& error) {
    throw std::runtime_error(fmt::format("{}:{}: is not YAML: {}", file.string(), error.mark.line + 1, error.msg));
  }
  if (!root.IsMap()) throw std::runtime_error(file.string() + ": must be a map with stereo and panorama");
  std::string problems;
  for (const auto& entry : root) {
    const auto key = entry.first.as<std::string>();
    if (key != "stereo" && key != "panorama" && key != "vehicle") {
      problems += fmt::format("{}:{}: {} is not known here; known keys: stereo, panorama, vehicle\n", file.string(),
                              entry.first.Mark().line + 1, key);
    }
  }
  RigSettings settings;
  Group stereo(file.string(), "stereo", root["stereo"], problems);
  read_stereo(stereo, settings.stereo);
  Group vehicle(file.string(), "vehicle", root["vehicle"], problems);
  vehicle.flag("has_body", settings.vehicle.has_body);
  vehicle.number("speed_m_per_s", settings.vehicle.speed_m_per_s, 0.1, 30.0, "m/s");
  vehicle.flag("turns_in_place", settings.vehicle.turns_in_place);
  vehicle.finish();
  Group panorama(file.string(), "panorama", root["panorama"], problems);
  read_panorama(panorama, settings.panorama, settings.vehicle.has_body);
  if (!problems.empty()) {
    problems.pop_back();
    throw std::runtime_error(problems);
  }
  return settings;
}

}  // namespace panvo::simulation
