// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "channel_table.hpp"
#include "client_request.hpp"
#include "frame_assembly.hpp"
#include "panvo/runtime/output.hpp"
#include "sender.hpp"
#include "web_server.hpp"

namespace panvo::web_view {

class View;

/// One client: its subscriptions and what it publishes. A topic is read only while the client subscribes to it.
class ClientSession final : public WebServer::Session {
 public:
  ClientSession(View& view, WebServer::Connection& connection);
  ~ClientSession() override;

  void receive(std::uint8_t head, std::span<const std::uint8_t> data) override;

  /// Tells the client of the server and of its channels.
  void welcome(const std::vector<Channel>& channels);
  /// Tells of new and removed channels; moves the subscriptions of removed ones to `ended`.
  void tell(const ChannelTable::Change& change, std::vector<std::shared_ptr<void>>& ended);

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
  void subscribe(const Subscribe::One& wanted);
  std::shared_ptr<void> take_subscription(std::uint32_t id);
  void advertise(const Advertise::One& wanted);
  void refuse_without_control() const;
  void complain(const std::string& why);

  View& view_;
  WebServer::Connection& connection_;
  FrameAssembly assembly_;
  Sender sender_;
  std::map<std::uint32_t, Publication> publications_;  // by id; used by the connection's thread only
  std::mutex mutex_;  // guards the next one; not held while a topic is opened or closed
  std::map<std::uint32_t, Subscription> subscriptions_;  // by id; last: their callbacks use the sender
};

}  // namespace panvo::web_view
