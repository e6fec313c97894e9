// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "client_request.hpp"
#include "connection_graph.hpp"
#include "frame_assembly.hpp"
#include "panvo/runtime/output.hpp"
#include "parameter_access.hpp"
#include "sender.hpp"
#include "server_message.hpp"
#include "slow_requests.hpp"
#include "web_server.hpp"

namespace panvo::web_view {

class View;

/// One client: its subscriptions and what it publishes. A topic is read only while the client subscribes to it.
/// client_session.cpp: topics. client_session_nodes.cpp: parameters, services, connection graph and assets.
class ClientSession final : public WebServer::Session {
 public:
  ClientSession(View& view, WebServer::Connection& connection);
  ~ClientSession() override;

  void receive(std::uint8_t head, std::span<const std::uint8_t> data) override;

  /// Tells the client of the server. `has_time`: times follow, see tell_time().
  void welcome(bool has_time);
  /// Tells of new and removed channels; moves the subscriptions of removed ones to `ended`.
  void tell(const ChannelTable::Change& change, std::vector<std::shared_ptr<void>>& ended);
  void tell(const ServiceTable::Change& change);
  /// To a client that asked for the graph: what has changed since it was told of it.
  void tell(const ConnectionGraph& graph);
  /// The time of the view, if it has changed. Restarts the session of a client that was welcomed without a time, because
  /// its clock differed.
  void tell_time();
  /// To a client that controls the playback, on a change of its status or speed, or if the time was moved. Others may not
  /// know the message.
  void tell_playback(bool is_moved);
  /// A warning if messages were dropped since the last one, at most every 10 s.
  void tell_drops();

  bool wants_graph() const;
  /// "127.0.0.1:4711".
  std::string address() const { return connection_.address(); }
  std::size_t subscriptions() const;
  std::uint64_t dropped() const { return sender_.dropped(); }

 private:
  struct Subscription {
    std::uint32_t channel;
    std::shared_ptr<void> reading;
  };
  struct Publication {
    const interfaces::MessageType* type;
    std::shared_ptr<runtime::UntypedOutput> output;
  };

  void handle(const Subscribe& request);
  void handle(const Unsubscribe& request);
  void handle(const Advertise& request);
  void handle(const Unadvertise& request);
  void handle(const Publish& request);
  void handle(const GetParameters& request);
  void handle(const SetParameters& request);
  void handle(const WatchParameters& request);
  void handle(const CallService& request);
  void handle(const WatchConnectionGraph& request);
  void handle(const FetchAsset& request);
  void handle(const ControlPlayback& request);
  void subscribe(const Subscribe::One& wanted);
  std::shared_ptr<void> take_subscription(std::uint32_t id);
  void advertise(const Advertise::One& wanted);
  void answer(const ParameterAccess::Result& result, const std::string& id, bool is_answer_wanted);
  void tell_changed(const runtime::SamplePtr& event);
  void refuse_without_control() const;
  void complain(const std::string& why);

  View& view_;
  WebServer::Connection& connection_;
  const SchemaNotation notation_;
  FrameAssembly assembly_;
  Sender sender_;
  std::map<std::uint32_t, Publication> publications_;  // by id; used by the connection's thread only
  std::atomic<bool> has_time_{false};
  std::mutex time_mutex_;                      // one time at a time
  std::atomic<std::int64_t> told_time_ns_{0};  // changed with time_mutex_ locked
  std::uint64_t told_drops_ = 0;
  std::chrono::steady_clock::time_point drops_told_at_{};
  mutable std::mutex mutex_;                    // guards the next seven; not held while a topic is opened or closed
  std::optional<PlaybackState> told_playback_;  // of a client that controls it
  bool wants_graph_ = false;
  ConnectionGraph told_graph_;
  bool watches_all_parameters_ = false;
  std::set<std::string> watched_parameters_;
  std::set<std::uint32_t> ended_;                        // subscriptions that ended with their channel
  std::map<std::uint32_t, Subscription> subscriptions_;  // by id; their callbacks use the sender
  std::shared_ptr<void> parameter_events_;               // so does its callback
  SlowRequests slow_requests_;                           // last: they use the members above
};

}  // namespace panvo::web_view
