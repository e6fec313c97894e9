// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <mutex>
#include <utility>

#include "discovery.hpp"
#include "image_sharing.hpp"
#include "image_writer.hpp"
#include "local_endpoints.hpp"
#include "node_graph.hpp"
#include "node_info.hpp"
#include "notifier.hpp"
#include "panvo/runtime/bridge.hpp"
#include "participant.hpp"
#include "participant_qos.hpp"
#include "reader.hpp"
#include "service_client.hpp"
#include "service_queue.hpp"
#include "service_server.hpp"

namespace panvo::runtime {
namespace {

/// All endpoints belong to one participant, so ROS 2 finds the node of each. Readers and writers of this process ignore
/// each other, see remote_only_filter.hpp. A participant has nine threads and is created on first use.
///
/// With a discovery server, readers have a participant of their own, which hears of all topics: newcomers do not find
/// the writers of such a participant after the server has been replaced.
class DdsBridge final : public Bridge {
 public:
  explicit DdsBridge(const DdsSettings& settings) : settings_(settings) {
    dds::load_profiles(settings_);
    for (const auto& warning : {dds::profile_warning(), dds::sharing_warning(settings_)}) {
      if (warning) notifier_->warn(*warning);
    }
    discovery_->on_nodes_reader([graph = std::weak_ptr(graph_)](const auto& reader, auto what) {
      if (const auto known = graph.lock()) known->nodes_reader(reader, what);
    });
    discovery_->on_participant_gone([graph = std::weak_ptr(graph_)](const auto& prefix) {
      if (const auto known = graph.lock()) known->participant_gone(prefix);
    });
  }

  // Open endpoints keep their participant; no callback of the notifier runs after this.
  ~DdsBridge() override {
    notifier_->stop();
    graph_->close();
  }

  std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic) override {
    return dds::open_writer(topic, dds::wire_topic(topic), participant(Role::kWrites), notifier_);
  }

  std::unique_ptr<BridgeReader> open_reader(const TopicDescription& topic,
                                            std::function<void(SamplePtr)> on_sample) override {
    return std::make_unique<dds::Reader>(topic, dds::wire_topic(topic), std::move(on_sample), participant(Role::kReads),
                                         notifier_);
  }

  void watch_topics(std::function<void(const TopicDescription&)> on_topic) override {
    discovery_->watch(on_topic);
    participant(Role::kReads);
  }

  std::unique_ptr<BridgeService> serve(const ServiceDescription& service, ServiceHandler handler,
                                       ServiceGuard guard) override {
    const dds::RequestLimits limits{settings_.requests_per_s, settings_.max_request};
    return std::make_unique<dds::ServiceServer>(service, std::move(handler), std::move(guard), limits,
                                                participant(Role::kReads), participant(Role::kWrites), services_,
                                                notifier_);
  }

  std::unique_ptr<BridgeClient> open_client(const ServiceDescription& service) override {
    return std::make_unique<dds::ServiceClient>(service, participant(Role::kReads), participant(Role::kWrites));
  }

  void set_nodes(std::vector<NodeDescription> nodes) override {
    {
      const std::lock_guard lock(graph_mutex_);
      graph_->open_writer(participant(Role::kWrites));
      graph_->open_reader(participant(Role::kReads));
    }
    graph_->set_nodes(std::move(nodes));
  }

  Graph graph() override {
    {
      const std::lock_guard lock(graph_mutex_);
      graph_->open_reader(participant(Role::kReads));
    }
    return {graph_->nodes(), discovery_->endpoints(), discovery_->participants()};
  }

  void on_warning(std::function<void(const std::string&)> callback) override {
    notifier_->on_warning(std::move(callback));
  }

 private:
  enum class Role { kWrites, kReads };

  std::shared_ptr<dds::Participant> participant(Role role) {
    const std::lock_guard lock(mutex_);
    if (has_server_ && !hearing_ && !participant_) watch_server();
    if (has_server_ && role == Role::kReads) {
      if (!hearing_) hearing_ = std::make_shared<dds::Participant>(settings_, dds::Hears::kAll, discovery_, endpoints_);
      return hearing_;
    }
    if (!participant_)
      participant_ = std::make_shared<dds::Participant>(settings_, dds::Hears::kMatching, discovery_, endpoints_);
    return participant_;
  }

  /// A server is itself a participant that the others see.
  void watch_server() {
    if (settings_.range == DiscoveryRange::kOff) return;
    notifier_->post_after(kServerPatience,
                          [discovery = std::weak_ptr(discovery_), notifier = std::weak_ptr(notifier_)] {
                            const auto known = discovery.lock();
                            const auto told = notifier.lock();
                            if (known && told && known->participants().empty())
                              told->warn(dds::silent_server_warning());
                          });
  }

  const DdsSettings settings_;
  const bool has_server_ = dds::has_discovery_server();
  const std::shared_ptr<dds::Notifier> notifier_ = std::make_shared<dds::Notifier>();
  const std::shared_ptr<dds::Discovery> discovery_ = std::make_shared<dds::Discovery>(notifier_);
  const std::shared_ptr<dds::LocalEndpoints> endpoints_ = std::make_shared<dds::LocalEndpoints>();
  const std::shared_ptr<dds::ServiceQueue> services_ = std::make_shared<dds::ServiceQueue>();
  std::mutex mutex_;
  std::shared_ptr<dds::Participant> participant_, hearing_;
  std::mutex graph_mutex_;
  // After the participant: destroyed before it.
  const std::shared_ptr<dds::NodeGraph> graph_ =
      std::make_shared<dds::NodeGraph>(notifier_, endpoints_, dds::is_until_humble(settings_.ros_distro));
};

}  // namespace

std::unique_ptr<Bridge> make_dds_bridge(const DdsSettings& settings) { return std::make_unique<DdsBridge>(settings); }

}  // namespace panvo::runtime
