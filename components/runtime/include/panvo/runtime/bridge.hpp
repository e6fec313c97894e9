// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "panvo/interfaces/qos.hpp"
#include "panvo/runtime/sample.hpp"

namespace panvo::runtime {

/// A topic as a process offers or wants it.
struct TopicDescription {
  std::string name;       ///< resolved: "/stereo/left/image_rect"
  std::string type_name;  ///< "sensor_msgs/msg/Image"
  interfaces::Qos qos;
  const interfaces::MessageType* type = nullptr;  ///< nullptr: not known here, bytes only
};

/// A topic of this process as other processes read it.
class BridgeWriter {
 public:
  virtual ~BridgeWriter() = default;
  /// Serialises and sends, unless nobody could ever want it: no matched reader, and not transient local. Never blocks longer than the
  /// topic's reliability allows (100 ms). Returns false when it could not be handed over (counted by the caller).
  virtual bool write(const SamplePtr& sample) = 0;
  virtual std::size_t matched_readers() const = 0;
  /// Waits until every matched reliable reader has all that was written.
  virtual bool wait_for_acknowledgments(std::chrono::milliseconds limit) = 0;
};

struct BridgeReaderCounters {
  std::uint64_t received = 0, lost = 0, undecodable = 0;
};

/// A topic of other processes as this process reads it. Its callback is not running any more when the destructor has returned.
class BridgeReader {
 public:
  virtual ~BridgeReader() = default;
  virtual std::size_t matched_writers() const = 0;
  virtual BridgeReaderCounters counters() const = 0;
};

/// What connects the topics of this process with those of others. Endpoints of the same process never meet through it: inside a process
/// messages pass by pointer. Safe to use from several threads; callbacks come from a thread of the bridge's.
class Bridge {
 public:
  virtual ~Bridge() = default;
  virtual std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic) = 0;
  virtual std::unique_ptr<BridgeReader> open_reader(const TopicDescription& topic,
                                                    std::function<void(SamplePtr)> on_sample) = 0;

  /// Calls back once for every topic that another process writes, those already known included. For recording and `topic list`.
  virtual void watch_topics(std::function<void(const TopicDescription&)> on_topic) = 0;

  /// Something users should know: a reader and writer that cannot meet (QoS or type differ), with topic name and remedy.
  virtual void on_warning(std::function<void(const std::string&)> callback) = 0;
};

struct DdsSettings {
  int domain = 0;              ///< from ROS_DOMAIN_ID
  std::string profiles;        ///< XML profile file, empty: our defaults
  std::string name = "panvo";  ///< participant name seen by other tools
};

/// The bridge over Fast DDS. Throws ConfigError when no participant can be made (bad profile file, no network at all).
std::unique_ptr<Bridge> make_dds_bridge(const DdsSettings& settings);

}  // namespace panvo::runtime
