// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/yaml_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "known_keys.hpp"
#include "load_yaml.hpp"

namespace panvo::calibration_files {
namespace {

int line_of(const YAML::Node& node) { return std::max(node.Mark().line, 0) + 1; }

/// The wrong value in a message: ", not 'wide'".
std::string not_this(const YAML::Node& node) {
  return node.IsScalar() ? fmt::format(", not '{}'", node.Scalar()) : std::string();
}

std::string to_text(const Range& range) {
  return fmt::format("from {:g} to {:g}{}{}", range.min, range.max, *range.unit == '\0' ? "" : " ", range.unit);
}

/// Not if the value is not a number, either.
bool contains(const Range& range, double value) { return value >= range.min && value <= range.max; }

// YAML aliases can make a list contain itself, and a few lines of them stand for billions of numbers.
constexpr int kDeepest = 2;                   // rows of a matrix
constexpr std::size_t kMostNumbers = 10'000;  // more than any calibration has

bool append_numbers(const YAML::Node& node, int deepest, std::vector<double>& numbers) {
  if (node.IsSequence()) {
    return deepest > 0 && std::all_of(node.begin(), node.end(), [&](const YAML::Node& item) {
             return append_numbers(item, deepest - 1, numbers);
           });
  }
  double value = 0.0;
  if (numbers.size() == kMostNumbers || !YAML::convert<double>::decode(node, value)) return false;
  numbers.push_back(value);
  return true;
}

/// The numbers of a list, of a list of rows or of a matrix; nullopt if it is something else.
std::optional<std::vector<double>> to_numbers(const YAML::Node& node) {
  const YAML::Node list = node.IsMap() ? node["data"] : node;
  std::vector<double> numbers;
  if (!list.IsDefined() || !list.IsSequence() || !append_numbers(list, kDeepest, numbers)) return std::nullopt;
  return numbers;
}

}  // namespace

/// One map of a file.
struct YamlMap::Part {
  std::string prefix;  // of its keys in messages: "heads[1]."
  int line;
  YAML::Node map;
  bool is_wrong;                     // the node is not a map, which is reported; its missing keys are not
  std::set<std::string> asked = {};  // keys

  YAML::Node find(const std::string& key) {
    asked.insert(key);
    return std::as_const(map)[key];
  }

  /// Line of a key, or of the map if it lacks the key.
  int line_of_key(const std::string& key) const {
    for (const auto& item : map) {
      if (item.first.Scalar() == key) return line_of(item.first);
    }
    return line;
  }
};

/// What all maps of a file share.
struct YamlMap::Document {
  struct Problem {
    int line;
    std::string text;
  };

  std::filesystem::path file;
  std::vector<Problem> problems = {};
  std::vector<std::shared_ptr<Part>> parts = {};

  void reject(int line, const std::string& key, const std::string& what) {
    problems.push_back({line, fmt::format("{}:{}: {} {}", file.string(), line, key, what)});
  }

  /// Adds the map `name`, which has no keys if it is missing.
  std::shared_ptr<Part> add(const std::string& name, int line, const YAML::Node& node) {
    const bool is_wrong = node.IsDefined() && !node.IsMap();
    const bool is_map = node.IsDefined() && node.IsMap();
    if (is_wrong) reject(line, name, "must be a map of `key: value` lines");
    const std::string prefix = name.empty() ? name : name + ".";
    const YAML::Node map = is_map ? node : YAML::Node(YAML::NodeType::Map);
    parts.push_back(std::make_shared<Part>(Part{prefix, line, map, is_wrong}));
    std::set<std::string> seen;
    for (const auto& item : parts.back()->map) {
      if (!seen.insert(item.first.Scalar()).second)
        reject(line_of(item.first), prefix + item.first.Scalar(), "is given twice; remove one of them");
    }
    return parts.back();
  }
};

YamlMap::YamlMap(const std::filesystem::path& file, const std::string& kind)
    : document_(std::make_shared<Document>(Document{file})) {
  const YAML::Node root = load_yaml_map(file, kind);
  part_ = document_->add("", line_of(root), root);
}

YamlMap::YamlMap(std::shared_ptr<Document> document, std::shared_ptr<Part> part)
    : document_(std::move(document)), part_(std::move(part)) {}

const std::filesystem::path& YamlMap::file() const { return document_->file; }

bool YamlMap::has(const std::string& key) { return part_->find(key).IsDefined(); }

template <class Value, class Decode>
Value YamlMap::read(const std::string& key, const std::optional<Value>& instead, const std::string& rule,
                    Decode decode) {
  const YAML::Node node = part_->find(key);
  Value value{};
  if (node.IsDefined() && decode(node, value)) return value;
  if (node.IsDefined()) {
    reject(key, fmt::format("must be {}{}", rule, not_this(node)));
  } else if (!instead) {
    reject(key, "is missing; add it");
  }
  return instead.value_or(Value{});
}

double YamlMap::number(const std::string& key, const Range& range, std::optional<double> instead) {
  return read(key, instead, "a number " + to_text(range), [&](const YAML::Node& node, double& value) {
    return YAML::convert<double>::decode(node, value) && contains(range, value);
  });
}

int YamlMap::integer(const std::string& key, int min, int max, std::optional<int> instead) {
  const auto rule = fmt::format("a whole number from {} to {}", min, max);
  return read(key, instead, rule, [&](const YAML::Node& node, int& value) {
    return YAML::convert<int>::decode(node, value) && value >= min && value <= max;
  });
}

bool YamlMap::flag(const std::string& key, std::optional<bool> instead) {
  return read(key, instead, "true or false", YAML::convert<bool>::decode);
}

std::string YamlMap::text(const std::string& key, const std::optional<std::string>& instead) {
  return read(key, instead, "a non-empty string", [&](const YAML::Node& node, std::string& value) {
    value = node.IsScalar() ? node.Scalar() : "";
    if (!value.empty()) return true;
    value = instead.value_or("");  // an empty text counts as missing
    return instead.has_value() && (node.IsScalar() || node.IsNull());
  });
}

std::string YamlMap::choice(const std::string& key, const std::vector<std::string>& words,
                            const std::optional<std::string>& instead) {
  const auto rule = fmt::format("one of {}", fmt::join(words, ", "));
  return read(key, instead, rule, [&](const YAML::Node& node, std::string& value) {
    value = node.IsScalar() ? node.Scalar() : "";
    return std::find(words.begin(), words.end(), value) != words.end();
  });
}

std::vector<double> YamlMap::numbers(const std::string& key, std::optional<std::size_t> count, const Range& range) {
  const YAML::Node node = part_->find(key);
  const auto values = node.IsDefined() ? to_numbers(node) : std::nullopt;
  const auto is_wrong = [&](double value) { return !contains(range, value); };
  const std::string list = count ? fmt::format("a list of {} numbers", *count) : std::string("a list of numbers");
  if (!node.IsDefined()) {
    reject(key, "is missing; add it");
  } else if (!values) {
    reject(key, fmt::format("must be {}, or a matrix (rows, cols, data)", list));
  } else if (count && values->size() != *count) {
    reject(key, fmt::format("must be {}, not of {}", list, values->size()));
  } else if (const auto wrong = std::find_if(values->begin(), values->end(), is_wrong); wrong != values->end()) {
    reject(key, fmt::format("must be {} {}, not {:g}", list, to_text(range), *wrong));
  } else {
    return *values;
  }
  return std::vector<double>(count.value_or(0));
}

std::array<int, 2> YamlMap::size_px(const std::string& key, int min, int max) {
  using Size = std::array<int, 2>;
  const auto rule = fmt::format("[width, height], whole numbers from {} to {} px", min, max);
  return read<Size>(key, {}, rule, [&](const YAML::Node& node, Size& size) {
    const auto values = to_numbers(node);
    const auto is_size = [&](double value) { return value >= min && value <= max && value == std::floor(value); };
    if (!values || values->size() != 2 || !std::all_of(values->begin(), values->end(), is_size)) return false;
    size = {static_cast<int>((*values)[0]), static_cast<int>((*values)[1])};
    return true;
  });
}

YamlMap YamlMap::map(const std::string& key) {
  const YAML::Node node = part_->find(key);
  return {document_, document_->add(part_->prefix + key, part_->line_of_key(key), node)};
}

std::vector<YamlMap> YamlMap::maps(const std::string& key) {
  const YAML::Node node = part_->find(key);
  std::vector<YamlMap> maps;
  if (!node.IsDefined()) {
    reject(key, "is missing; add it");
  } else if (!node.IsSequence() || node.size() == 0) {
    reject(key, "must be a list of at least one map: lines that begin with `- `");
  }
  for (std::size_t i = 0; node.IsDefined() && node.IsSequence() && i < node.size(); ++i) {
    const std::string name = fmt::format("{}{}[{}]", part_->prefix, key, i);
    const YAML::Node item = node[i];
    maps.push_back({document_, document_->add(name, line_of(item), item)});
  }
  return maps;
}

std::string YamlMap::where(const std::string& key) const {
  return fmt::format("{}:{}: {}{}", file().string(), part_->line_of_key(key), part_->prefix, key);
}

void YamlMap::reject(const std::string& key, const std::string& what) {
  if (!part_->is_wrong) document_->reject(part_->line_of_key(key), part_->prefix + key, what);
}

void YamlMap::include(const std::string& key, const FileError& error) {
  auto& known = document_->problems;
  if (std::none_of(known.begin(), known.end(), [&](const auto& problem) { return problem.text == error.what(); }))
    known.push_back({part_->line_of_key(key), error.what()});
}

std::size_t YamlMap::problems() const { return document_->problems.size(); }

void YamlMap::check() const {
  if (problems() == 0) return;
  auto sorted = document_->problems;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  std::string text;
  for (const auto& problem : sorted) text += (text.empty() ? "" : "\n") + problem.text;
  throw FileError(text);
}

void YamlMap::finish() {
  for (const auto& part : document_->parts) {
    for (const auto& item : part->map) {
      const auto& key = item.first.Scalar();
      if (!part->asked.contains(key))
        document_->reject(line_of(item.first), part->prefix + key, "is not a known key" + known_keys(key, part->asked));
    }
  }
  check();
}

}  // namespace panvo::calibration_files
