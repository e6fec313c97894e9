// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/route.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulation {

namespace {

// A route file, for messages with file and line.
class RouteFile {
 public:
  explicit RouteFile(const std::filesystem::path& file) : file_(file) {}

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    const std::string line = mark.is_null() ? "" : fmt::format(":{}", mark.line + 1);
    throw std::runtime_error(file_.string() + line + ": " + what);
  }

  YAML::Node load() const {
    std::error_code error;
    if (std::filesystem::is_directory(file_, error)) fail(YAML::Mark::null_mark(), "is a folder, not a route file");
    std::ifstream stream(file_, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    if (!stream) fail(YAML::Mark::null_mark(), "cannot be read; check the path");
    try {
      return YAML::Load(content.str());
    } catch (const YAML::Exception& exception) {
      fail(exception.mark, "is not YAML: " + exception.msg + "; check indentation, colons, brackets and quotes");
    }
  }

  std::string text(const YAML::Node& value, const std::string& key) const {
    if (!value.IsScalar() || value.Scalar().empty()) fail(value.Mark(), key + ": must be a string");
    return value.Scalar();
  }

 private:
  std::filesystem::path file_;
};

}  // namespace

Route read_route(const std::filesystem::path& file) {
  const RouteFile route_file(file);
  const YAML::Node document = route_file.load();
  if (!document.IsMap()) {
    route_file.fail(document.Mark(), "must be a map with the keys name, junctions and description");
  }
  Route route;
  std::vector<std::string> seen;
  for (const auto& entry : document) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const YAML::Node& value = entry.second;
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
      route_file.fail(entry.first.Mark(), key + ": is duplicated; remove one");
    }
    seen.push_back(key);
    if (key == "name") {
      route.name = route_file.text(value, key);
    } else if (key == "description") {
      route.description = route_file.text(value, key);
    } else if (key == "junctions") {
      if (!value.IsSequence() || value.size() < 2) {
        route_file.fail(entry.first.Mark(), "junctions: must be a list of at least two junction names");
      }
      for (const auto& junction : value) route.junctions.push_back(route_file.text(junction, key));
    } else {
      route_file.fail(entry.first.Mark(), fmt::format("{}: is not known here; known keys: name, junctions and "
                                                      "description",
                                                      key));
    }
  }
  for (const char* key : {"name", "junctions"}) {
    if (std::find(seen.begin(), seen.end(), key) == seen.end()) {
      route_file.fail(document.Mark(), fmt::format("{}: is missing", key));
    }
  }
  return route;
}

Route random_route(const simulated_world::RoadNetwork& roads, int junctions, std::uint64_t seed) {
  if (junctions < 2) throw std::invalid_argument(fmt::format("a route needs at least 2 junctions, not {}", junctions));
  simulated_world::Random random(seed, "random route");
  std::vector<int> starts;
  for (std::size_t i = 0; i < roads.junctions.size(); ++i) {
    if (!roads.junctions[i].roads.empty()) starts.push_back(static_cast<int>(i));
  }
  if (starts.empty()) throw std::invalid_argument("no random route is possible: the network has no roads");

  Route route;
  route.name = fmt::format("random_{}", seed);
  route.description = fmt::format("{} junctions drawn from seed {}", junctions, seed);
  int here = starts[static_cast<std::size_t>(random.below(static_cast<int>(starts.size())))];
  int came_by = -1;
  while (true) {
    const simulated_world::Junction& junction = roads.junctions[static_cast<std::size_t>(here)];
    route.junctions.push_back(junction.name);
    if (static_cast<int>(route.junctions.size()) == junctions) return route;
    std::vector<int> ways_on;
    for (const int road : junction.roads) {
      if (road != came_by) ways_on.push_back(road);
    }
    if (ways_on.empty()) ways_on = junction.roads;
    came_by = ways_on[static_cast<std::size_t>(random.below(static_cast<int>(ways_on.size())))];
    const simulated_world::Road& road = roads.roads[static_cast<std::size_t>(came_by)];
    here = road.from == here ? road.to : road.from;
  }
}

}  // namespace panvo::simulation
