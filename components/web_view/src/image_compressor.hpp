// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "panvo/runtime/graph.hpp"
#include "panvo/runtime/topic_access.hpp"

namespace panvo::web_view {

/// Offers raw images compressed too, as viewers beyond a slow link need. Thread-safe.
class ImageCompressor {
 public:
  /// The published topics, and TOPIC/compressed for each image topic without one.
  std::vector<runtime::TopicDescription> offer(std::vector<runtime::TopicDescription> published);

  /// The image topic from which an offered one is made; nullopt: it is published itself.
  std::optional<runtime::TopicDescription> source_of(const std::string& compressed) const;

  /// A sensor_msgs/CompressedImage of a sensor_msgs/Image, for several clients once; nullptr: JPEG cannot hold it.
  runtime::SamplePtr compressed(const runtime::SamplePtr& image);

 private:
  using Pair = std::pair<std::weak_ptr<const runtime::Sample>, runtime::SamplePtr>;  // image, compressed

  mutable std::mutex mutex_;  // guards the following
  std::map<std::string, runtime::TopicDescription> sources_;
  std::deque<Pair> recent_;
};

}  // namespace panvo::web_view
