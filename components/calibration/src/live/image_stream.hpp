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

/// The images that other processes publish on several topics, those taken at once together. Of sets that come faster than they are taken the
/// newest is kept.
class ImageStream {
 public:
  using Clock = std::chrono::steady_clock;
  using Set = FrameSets<runtime::SamplePtr>::Set;

  /// Waits up to `timeout` for who publishes them. Throws CalibrationError when a topic has nobody, naming those that have.
  ImageStream(const std::vector<CameraTopic>& cameras, std::chrono::milliseconds timeout, std::int64_t tolerance_ns);

  /// The newest set that was not taken yet; nullopt: none came until `end`, or Ctrl-C did.
  std::optional<Set> next(Clock::time_point end);

  /// Why no set comes: which topic has no images, or how far apart their stamps are.
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
  std::vector<std::unique_ptr<runtime::BridgeReader>> readers_;  // last: they call take()
};

}  // namespace panvo::calibration
