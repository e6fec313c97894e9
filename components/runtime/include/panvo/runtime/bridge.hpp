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

/// A topic that a process publishes or subscribes to.
struct TopicDescription {
  std::string name;       ///< resolved: "/stereo/left/image_rect"
  std::string type_name;  ///< "sensor_msgs/msg/Image"
  interfaces::Qos qos;
  const interfaces::MessageType* type = nullptr;  ///< nullptr: type unknown here, bytes only
};

/// Publishes a topic of this process to other processes.
class BridgeWriter {
 public:
  virtual ~BridgeWriter() = default;
  /// Serialises and sends `sample`, unless there is no matched reader and the topic is not transient local. Blocks at
  /// most 100 ms, and only on keep-all topics with slow reliable readers. Returns false if the sample could not be
  /// handed over; the caller counts this.
  virtual bool write(const SamplePtr& sample) = 0;
  virtual std::size_t matched_readers() const = 0;
  /// Waits until all matched reliable readers have acknowledged all samples; false on timeout.
  virtual bool wait_for_acknowledgments(std::chrono::milliseconds limit) = 0;
};

struct BridgeReaderCounters {
  std::uint64_t received = 0, lost = 0, undecodable = 0;
  std::uint64_t overwritten = 0;  ///< overwritten by the writer in shared memory while being read: dropped
  std::uint64_t too_large = 0;    ///< larger than Limits::max_message_bytes: dropped before copying
  std::uint64_t too_fast = 0;     ///< beyond Limits::max_topic_rate_hz: dropped
};

/// Receives a topic from other processes. No callback is running once the destructor has returned.
class BridgeReader {
 public:
  virtual ~BridgeReader() = default;
  virtual std::size_t matched_writers() const = 0;
  virtual BridgeReaderCounters counters() const = 0;
};

/// Connects the topics and services of this process with those of other processes. Endpoints of the same process are
/// never connected through the bridge; messages within a process are passed by pointer. Thread-safe. Callbacks run on a
/// bridge thread.
class Bridge {
 public:
  virtual ~Bridge() = default;
  virtual std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic) = 0;
  virtual std::unique_ptr<BridgeReader> open_reader(const TopicDescription& topic,
                                                    std::function<void(SamplePtr)> on_sample) = 0;

  /// Calls `on_topic` once for each topic that another process publishes, including those already known. Used by the
  /// recorder and `topic list`.
  virtual void watch_topics(std::function<void(const TopicDescription&)> on_topic) = 0;

  /// Offers a service. All services of the bridge share one thread, so a slow handler delays the others. Requests that
  /// arrive faster than they are answered are dropped and counted.
  virtual std::unique_ptr<BridgeService> serve(const ServiceDescription& service, ServiceHandler handler,
                                               ServiceGuard guard) = 0;
  std::unique_ptr<BridgeService> serve(const ServiceDescription& service, ServiceHandler handler) {
    return serve(service, std::move(handler), nullptr);
  }
  virtual std::unique_ptr<BridgeClient> open_client(const ServiceDescription& service) = 0;

  /// Sets the nodes of this process, with their topics and services, as ROS 2 tools list them. Endpoints opened later
  /// are added automatically.
  virtual void set_nodes(std::vector<NodeDescription> nodes) = 0;
  /// Nodes and endpoints of other processes. The result is incomplete for a while after the first call.
  virtual Graph graph() = 0;

  /// Reports user-facing warnings, such as a reader and writer with incompatible QoS or types, with topic name and
  /// remedy.
  virtual void on_warning(std::function<void(const std::string&)> callback) = 0;
};

/// Limits on messages received from other processes and sources.
struct Limits {
  std::size_t max_message_bytes = 64'000'000;  ///< serialised size: an uncompressed colour image of 21 megapixels
  double max_topic_rate_hz = 1000.0;           ///< per topic, averaged over about 1 s: the rate of the fastest IMUs
};

/// A discovery server that has not answered for so long is reported: it is asked twice a second.
inline constexpr std::chrono::seconds kServerPatience{3};

/// Where to look for other processes, as ROS_AUTOMATIC_DISCOVERY_RANGE of ROS 2.
enum class DiscoveryRange : std::uint8_t {
  kOff,            ///< nowhere: nothing is exchanged with other processes
  kLocalhost,      ///< on this machine, without multicast
  kLoopback,       ///< the same by 127.0.0.1 only, as ROS_LOCALHOST_ONLY up to ROS 2 Humble
  kSubnet,         ///< by multicast
  kSystemDefault,  ///< as the DDS profile says
};

struct DdsSettings {
  static constexpr int kMaxDomain = 232;  ///< higher domains would exceed port 65535

  int domain = 0;
  std::string profiles;              ///< XML profile file; empty: built-in defaults
  std::string name = "panvo";        ///< participant name seen by other tools
  std::string ros_distro = "jazzy";  ///< of the ROS 2 nodes: "humble" uses another ros_discovery_info format
  DiscoveryRange range = DiscoveryRange::kSubnet;
  std::vector<std::string> peers{};  ///< hosts to look for, by name or address; not with kOff and kSystemDefault
  /// Largest image (bytes of pixels) that is shared in memory with processes of this machine that also share images.
  /// The memory is sized by the received images. 0: no sharing.
  std::uint32_t shared_image_bytes = 0;
  Limits limits{};
  double requests_per_s = 1000;           ///< per service; excess requests are dropped and counted
  std::uint32_t max_request = 1'000'000;  ///< bytes; larger requests are dropped and counted
};

/// Settings from ROS 2's environment variables ROS_DOMAIN_ID, ROS_DISTRO, ROS_LOCALHOST_ONLY,
/// ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_STATIC_PEERS. ROS_DISCOVERY_SERVER is read by Fast DDS. Throws ConfigError on
/// an invalid value.
DdsSettings dds_settings_from_environment();

/// Creates a bridge over Fast DDS. Throws ConfigError if no participant can be created (invalid profile file, no
/// network interface).
std::unique_ptr<Bridge> make_dds_bridge(const DdsSettings& settings);

}  // namespace panvo::runtime
