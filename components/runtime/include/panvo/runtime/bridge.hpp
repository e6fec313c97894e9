// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "panvo/interfaces/qos.hpp"
#include "panvo/runtime/sample.hpp"
#include "panvo/runtime/service.hpp"

namespace panvo::runtime {

struct Graph;
struct NodeDescription;

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
  std::uint64_t overwritten = 0;  ///< in shared memory, by their writer, while they were read: dropped
  std::uint64_t too_large = 0;    ///< than Limits::max_message_bytes: dropped before they were copied
  std::uint64_t too_fast = 0;     ///< beyond Limits::max_topic_rate_hz: dropped
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

  /// Offers a service. The handler runs on a thread that all services of the bridge share, so that a slow one holds no more than the others;
  /// of requests that come faster than they are answered some are dropped and counted.
  virtual std::unique_ptr<BridgeService> serve(const ServiceDescription& service, ServiceHandler handler,
                                               ServiceGuard guard) = 0;
  std::unique_ptr<BridgeService> serve(const ServiceDescription& service, ServiceHandler handler) {
    return serve(service, std::move(handler), nullptr);
  }
  virtual std::unique_ptr<BridgeClient> open_client(const ServiceDescription& service) = 0;

  /// The nodes of this process from now on, with what they have, as ROS 2 tools list them. Endpoints that come later are added by themselves.
  virtual void set_nodes(std::vector<NodeDescription> nodes) = 0;
  /// What other processes have. What it tells grows for a while after the first call.
  virtual Graph graph() = 0;

  /// Something users should know: a reader and writer that cannot meet (QoS or type differ), with topic name and remedy.
  virtual void on_warning(std::function<void(const std::string&)> callback) = 0;
};

/// What a process takes from others, whoever they are.
struct Limits {
  std::size_t max_message_bytes = 64'000'000;  ///< serialised: an uncompressed colour image of 21 megapixels
  double max_topic_rate_hz = 1000.0;           ///< of one topic, over a second or so: the rate of the fastest IMUs
};

struct DdsSettings {
  int domain = 0;
  std::string profiles;              ///< XML profile file, empty: our defaults
  std::string name = "panvo";        ///< participant name seen by other tools
  std::string ros_distro = "jazzy";  ///< whose nodes are to see ours: "humble" wrote ros_discovery_info in another way
  bool localhost_only = false;       ///< nothing leaves this machine
  /// Images of up to so many bytes of pixels pass to processes of this machine that share them too without being sent: they are written once, in
  /// memory that is made for the size that comes. 0: none do.
  std::uint32_t shared_image_bytes = 0;
  Limits limits{};
  double requests_per_s = 1000;               ///< of one service, that are answered; more are dropped and counted
  std::uint32_t largest_request = 1'000'000;  ///< bytes; larger ones are dropped and counted
};

/// As ROS 2's environment variables say: ROS_DOMAIN_ID, ROS_DISTRO, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE. ROS_DISCOVERY_SERVER is
/// read by Fast DDS. Throws ConfigError for a value that is none.
DdsSettings dds_settings_from_environment();

/// The bridge over Fast DDS. Throws ConfigError when no participant can be made (bad profile file, no network at all).
std::unique_ptr<Bridge> make_dds_bridge(const DdsSettings& settings);

}  // namespace panvo::runtime
