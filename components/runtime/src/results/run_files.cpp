// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/run_files.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "odometry_lines.hpp"
#include "output_file.hpp"
#include "run_json.hpp"

namespace panvo::runtime {
namespace {

struct OdometryKind {
  std::string_view topic_ending;
  std::string_view file_stem;
  bool has_covariances;
};

constexpr std::array<OdometryKind, 3> kKinds{{{"/odometry/binocular", "odometry_binocular", true},
                                              {"/odometry/enhanced", "odometry_enhanced", false},
                                              {"/ground_truth/odometry", "ground_truth", false}}};

const OdometryKind* kind_of(const TopicDescription& topic) {
  if (topic.type_name != interfaces::message_type<nav_msgs::msg::Odometry>().name) {
    return nullptr;
  }
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const auto& kind) { return topic.name.ends_with(kind.topic_ending); });
  return found == kKinds.end() ? nullptr : &*found;
}

/// "/fleet/robot/odometry/binocular" -> "fleet_robot_"
std::string prefix_of(std::string_view topic, const OdometryKind& kind) {
  topic.remove_suffix(kind.topic_ending.size() - 1);
  std::string prefix(topic.substr(topic.starts_with('/') ? 1 : 0));
  std::replace(prefix.begin(), prefix.end(), '/', '_');
  return prefix;
}

/// nullptr if the bytes are no Odometry.
std::shared_ptr<const nav_msgs::msg::Odometry> odometry_of(const SamplePtr& sample) {
  try {
    return Sample::as<nav_msgs::msg::Odometry>(sample);
  } catch (const interfaces::DecodeError&) {
    return nullptr;
  }
}

}  // namespace

struct RunFiles::OdometryFiles {
  OdometryFiles(const std::filesystem::path& folder, const std::string& stem, const OdometryKind& kind_of_topic)
      : kind(&kind_of_topic), poses(folder / (stem + ".tum")) {
    if (kind->has_covariances) {
      covariances.emplace(folder / (stem + "_covariance.csv"));
      covariances->append(covariance_header());
    }
  }

  static void append(LineFile& file, const std::optional<std::string>& line, std::uint64_t& left_out) {
    if (line) {
      file.append(*line);
    } else {
      ++left_out;
    }
  }

  const OdometryKind* kind;
  LineFile poses;
  std::optional<LineFile> covariances;
  std::uint64_t poses_left_out = 0, covariances_left_out = 0;
};

RunFiles::RunFiles(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) {
    throw_cannot_write(folder_, error.value());
  }
  for (const auto& kind : kKinds) {
    std::filesystem::remove(folder_ / (std::string(kind.file_stem) + ".tum"), error);
    std::filesystem::remove(folder_ / (std::string(kind.file_stem) + "_covariance.csv"), error);
  }
  std::filesystem::remove(folder_ / kSummaryFile, error);
  std::filesystem::remove(folder_ / kTimingFile, error);
  // Found out now rather than at the end of a long run.
  write_atomically(folder_ / kTimingFile, to_text(timing_json({})));
  std::filesystem::remove(folder_ / kTimingFile, error);
}

RunFiles::~RunFiles() = default;

bool RunFiles::wants(const TopicDescription& topic) const { return kind_of(topic) != nullptr; }

void RunFiles::write(const TopicDescription& topic, const SamplePtr& sample) {
  const OdometryKind* kind = kind_of(topic);
  if (kind == nullptr) {
    return;
  }
  const auto odometry = odometry_of(sample);

  const std::lock_guard lock(mutex_);
  auto& files = files_by_topic_[topic.name];
  if (files == nullptr) {
    const bool taken = std::any_of(files_by_topic_.begin(), files_by_topic_.end(), [&](const auto& other) {
      return other.second != nullptr && other.second->kind == kind;
    });
    const auto stem = (taken ? prefix_of(topic.name, *kind) : "") + std::string(kind->file_stem);
    files = std::make_unique<OdometryFiles>(folder_, stem, *kind);
  }
  OdometryFiles::append(files->poses, odometry ? tum_line(*odometry) : std::nullopt, files->poses_left_out);
  if (files->covariances) {
    OdometryFiles::append(*files->covariances, odometry ? covariance_line(*odometry) : std::nullopt,
                          files->covariances_left_out);
  }
}

void RunFiles::finish(const RunSummary& summary, const ComponentTimes& times_by_component) {
  RunSummary complete = summary;
  const auto report = [&complete](const LineFile& file, std::uint64_t left_out, const std::string& topic) {
    if (left_out > 0) {
      complete.problems.push_back(file.path().filename().string() + " lacks " + std::to_string(left_out) +
                                  " messages of " + topic + ": undecodable, or with numbers that are not finite");
    }
  };
  const std::lock_guard lock(mutex_);
  for (const auto& [topic, files] : files_by_topic_) {
    if (files != nullptr) {
      report(files->poses, files->poses_left_out, topic);
    }
    if (files != nullptr && files->covariances) {
      report(*files->covariances, files->covariances_left_out, topic);
    }
  }
  write_atomically(folder_ / kTimingFile, to_text(timing_json(times_by_component)));
  write_atomically(folder_ / kSummaryFile, to_text(summary_json(complete)));
}

}  // namespace panvo::runtime
