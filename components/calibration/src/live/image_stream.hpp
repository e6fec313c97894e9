// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "frame_sets.hpp"
#include "messages/camera_topic.hpp"
#include "panvo/runtime/bridge.hpp"

namespace panvo::calibration {

/// Receives images of several topics from other processes, grouped into simultaneous sets. Keeps only the newest set
/// that has not been taken.
class ImageStream {
 public:
  using Clock = std::chrono::steady_clock;
  using Set = FrameSets<runtime::SamplePtr>::Set;

  /// Waits up to `timeout` for publishers. Throws CalibrationError if a topic has no publisher, with the available
  /// topics.
  ImageStream(const std::vector<CameraTopic>& cameras, std::chrono::milliseconds timeout, std::int64_t tolerance_ns);

  /// Waits for and takes the newest set; nullopt at `end` or after Ctrl-C.
  std::optional<Set> next(Clock::time_point end);

  /// Describes why there is no set: a topic without images, or the difference of the stamps.
  std::string why_none() const;

 private:
  /// The types of the topics, by camera.
  std::vector<std::string> await_publishers(std::chrono::milliseconds timeout);
  void take(std::size_t camera, const runtime::SamplePtr& sample);

  std::vector<CameraTopic> cameras_;
  mutable std::mutex mutex_;
  std::condition_variable came_;
  FrameSets<runtime::SamplePtr> sets_;
  std::vector<std::size_t> received_;  // images of each camera
  std::optional<Set> newest_;
  std::unique_ptr<runtime::Bridge> bridge_;
  std::vector<std::unique_ptr<runtime::BridgeReader>> readers_;  // declared last, since they call take()
};

}  // namespace panvo::calibration
