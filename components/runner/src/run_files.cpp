// SPDX-License-Identifier: Apache-2.0
#include "panvo/runner/run_files.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "localization_lines.hpp"
#include "odometry_lines.hpp"
#include "output_file.hpp"
#include "place_lines.hpp"
#include "run_json.hpp"

namespace panvo::runner {
namespace {

using OptionalLine = std::optional<std::string>;

/// Result file of a topic, and the conversion of its messages to lines.
struct FileKind {
  std::string_view topic_ending;
  std::string_view type_name;
  std::string_view file_stem, file_ending;
  std::string (*header)();                          ///< nullptr: no header
  OptionalLine (*line)(const runtime::SamplePtr&);  ///< nullopt: not writable; throws DecodeError
};

template <class Message, OptionalLine (*kLine)(const Message&)>
OptionalLine line_of(const runtime::SamplePtr& sample) {
  return kLine(*runtime::Sample::as<Message>(sample));
}

const std::vector<FileKind>& file_kinds() {
  using interfaces::message_type;
  using nav_msgs::msg::Odometry;
  using panvo_msgs::msg::AzimuthChange;
  using panvo_msgs::msg::CorrectionOutcome;
  using panvo_msgs::msg::Integrity;
  using panvo_msgs::msg::LandmarkMatch;
  using panvo_msgs::msg::LocalizationState;
  using panvo_msgs::msg::OdometryQuality;
  using panvo_msgs::msg::PanoramicLandmark;
  using panvo_msgs::msg::PositionCorrection;
  static const std::string_view odometry = message_type<Odometry>().name;
  static const std::string_view landmark = message_type<PanoramicLandmark>().name;
  static const std::string_view match = message_type<LandmarkMatch>().name;
  static const std::string_view azimuth = message_type<AzimuthChange>().name;
  static const std::string_view correction = message_type<PositionCorrection>().name;
  static const std::string_view outcome = message_type<CorrectionOutcome>().name;
  static const std::string_view quality = message_type<OdometryQuality>().name;
  static const std::string_view state = message_type<LocalizationState>().name;
  static const std::string_view integrity = message_type<Integrity>().name;
  constexpr auto kPose = line_of<Odometry, tum_line>;
  static const std::vector<FileKind> kinds{
      {"/odometry/binocular", odometry, "odometry_binocular", ".tum", nullptr, kPose},
      {"/odometry/binocular", odometry, "odometry_binocular", "_covariance.csv", covariance_header,
       line_of<Odometry, covariance_line>},
      {"/odometry/enhanced", odometry, "odometry_enhanced", ".tum", nullptr, kPose},
      {"/odometry/enhanced", odometry, "odometry_enhanced", "_covariance.csv", covariance_header,
       line_of<Odometry, covariance_line>},
      {"/odometry/fleet", odometry, "odometry_fleet", ".tum", nullptr, kPose},
      {"/odometry/fleet", odometry, "odometry_fleet", "_covariance.csv", covariance_header,
       line_of<Odometry, covariance_line>},
      {"/odometry/quality", quality, "quality", ".csv", quality_header, line_of<OdometryQuality, quality_line>},
      {"/compass/azimuth_change", azimuth, "azimuth", ".csv", azimuth_header, line_of<AzimuthChange, azimuth_line>},
      {"/ground_truth/odometry", odometry, "ground_truth", ".tum", nullptr, kPose},
      {"/landmarks", landmark, "landmarks", ".csv", landmark_header, line_of<PanoramicLandmark, landmark_line>},
      {"/landmarks/match", match, "matches", ".csv", match_header, line_of<LandmarkMatch, match_line>},
      {"/correction", correction, "corrections", ".csv", correction_header,
       line_of<PositionCorrection, correction_line>},
      {"/correction/outcome", outcome, "outcomes", ".csv", outcome_header, line_of<CorrectionOutcome, outcome_line>},
      {"/localization/state", state, "states", ".csv", state_header, line_of<LocalizationState, state_line>},
      {"/localization/integrity", integrity, "integrity", ".csv", integrity_header,
       line_of<Integrity, integrity_line>}};
  return kinds;
}

bool is_of(const runtime::TopicDescription& topic, const FileKind& kind) {
  return topic.type_name == kind.type_name && topic.name.ends_with(kind.topic_ending);
}

std::string file_name_of(const FileKind& kind) { return std::string(kind.file_stem) + std::string(kind.file_ending); }

/// "/fleet/robot/odometry/binocular" -> "fleet_robot_"
std::string prefix_of(std::string_view topic, const FileKind& kind) {
  topic.remove_suffix(kind.topic_ending.size() - 1);
  std::string prefix(topic.substr(topic.starts_with('/') ? 1 : 0));
  std::replace(prefix.begin(), prefix.end(), '/', '_');
  return prefix;
}

}  // namespace

bool is_result_file(std::string_view name, bool may_have_namespace) {
  return std::ranges::any_of(file_kinds(), [&](const FileKind& kind) {
    const std::string plain = file_name_of(kind);
    return name == plain || (may_have_namespace && name.ends_with("_" + plain));
  });
}

std::string nothing_written(const std::filesystem::path& folder) {
  return "nothing was written to " + folder.string() + ": no odometry, landmark or other result was published";
}

struct RunFiles::TopicFile {
  TopicFile(const std::filesystem::path& path, const FileKind& kind_of_file) : kind(&kind_of_file), lines(path) {
    if (kind->header != nullptr) lines.append(kind->header());
  }

  void append(const runtime::SamplePtr& sample) {
    OptionalLine line;
    try {
      line = kind->line(sample);
    } catch (const interfaces::DecodeError&) {  // undecodable
    }
    if (line) {
      lines.append(*line);
      ++written;
    } else {
      ++left_out;
    }
  }

  const FileKind* kind;
  LineFile lines;
  std::uint64_t written = 0, left_out = 0;
};

RunFiles::RunFiles(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) {
    throw_cannot_write(folder_, error.value());
  }
  for (const auto& kind : file_kinds()) std::filesystem::remove(folder_ / file_name_of(kind), error);
  std::filesystem::remove(folder_ / kSummaryFile, error);
  std::filesystem::remove(folder_ / kTimingFile, error);
  // Detects write errors now instead of at the end of a long run.
  write_atomically(folder_ / kTimingFile, to_text(timing_json({})));
  std::filesystem::remove(folder_ / kTimingFile, error);
}

RunFiles::~RunFiles() = default;

bool RunFiles::wants(const runtime::TopicDescription& topic) const {
  return std::any_of(file_kinds().begin(), file_kinds().end(), [&](const auto& kind) { return is_of(topic, kind); });
}

void RunFiles::write(const runtime::TopicDescription& topic, const runtime::SamplePtr& sample) {
  const auto [found, is_new] = files_by_topic_.try_emplace(topic.name);
  if (is_new) {
    for (const auto& kind : file_kinds()) {
      if (!is_of(topic, kind)) continue;
      const bool is_taken = std::any_of(files_by_topic_.begin(), files_by_topic_.end(), [&](const auto& other) {
        return std::any_of(other.second.begin(), other.second.end(),
                           [&](const auto& file) { return file->kind == &kind; });
      });
      found->second.push_back(std::make_unique<TopicFile>(
          folder_ / ((is_taken ? prefix_of(topic.name, kind) : "") + file_name_of(kind)), kind));
    }
  }
  for (const auto& file : found->second) file->append(sample);
}

std::uint64_t RunFiles::lines() const {
  std::uint64_t lines = 0;
  for (const auto& [topic, files] : files_by_topic_) {
    for (const auto& file : files) lines += file->written;
  }
  return lines;
}

void RunFiles::finish(const RunSummary& summary, const runtime::ComponentTimes& times_by_component) {
  RunSummary complete = summary;
  complete.lines = lines();
  for (const auto& [topic, files] : files_by_topic_) {
    for (const auto& file : files) {
      if (file->left_out == 0) continue;
      complete.problems.push_back(file->lines.path().filename().string() + " lacks " + std::to_string(file->left_out) +
                                  " messages of " + topic + ": undecodable, or with non-finite numbers");
    }
  }
  write_atomically(folder_ / kTimingFile, to_text(timing_json(times_by_component)));
  write_atomically(folder_ / kSummaryFile, to_text(summary_json(complete)));
}

}  // namespace panvo::runner
