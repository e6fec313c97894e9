// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/timing.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "panvo/evaluation/input_error.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kTimingRemedy = "write the file again with `panvo run`, or remove it to evaluate without times";

// A node of the document, with its path for error messages.
struct Node {
  const std::filesystem::path& file;
  const Json& json;
  std::string key;

  Node at(const std::string& name) const {
    if (!json.is_object() || !json.contains(name)) {
      throw InputError(file, "no key '" + name + "' in '" + key + "'", kTimingRemedy);
    }
    return {file, json.at(name), key.empty() ? name : key + "." + name};
  }

  const Json& object() const {
    if (!json.is_object()) throw InputError(file, "'" + key + "' is not an object", kTimingRemedy);
    return json;
  }

  double milliseconds() const {
    if (!json.is_number() || !(json.get<double>() >= 0.0) || !std::isfinite(json.get<double>())) {
      throw InputError(file, "'" + key + "' is not a number of milliseconds", kTimingRemedy);
    }
    return json.get<double>();
  }

  TimeSummary summary() const {
    return {at("mean").milliseconds(), at("median").milliseconds(), at("p95").milliseconds(), at("p99").milliseconds(),
            at("max").milliseconds()};
  }
};

}  // namespace

StageTimes read_timing(const std::filesystem::path& file) {
  Json document;
  try {
    document = Json::parse(read_text(file));
  } catch (const Json::parse_error& error) {
    throw InputError(file, std::string("is not valid JSON: ") + error.what(), kTimingRemedy);
  }
  StageTimes times;
  const Node components = Node{file, document, ""}.at("components");
  for (const auto& component : components.object().items()) {
    const Node stages = components.at(component.key()).at("stages");
    for (const auto& stage : stages.object().items()) {
      const Node node = stages.at(stage.key());
      const Node count = node.at("count");
      if (!count.json.is_number_integer())
        throw InputError(file, "'" + count.key + "' is not a whole number", kTimingRemedy);
      times.push_back({component.key(), stage.key(), count.json.get<std::int64_t>(), node.at("wall_ms").summary(),
                       node.at("cpu_ms").summary()});
    }
  }
  return times;
}

}  // namespace panvo::evaluation
