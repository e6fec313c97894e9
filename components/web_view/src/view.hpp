// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "channel_table.hpp"
#include "page.hpp"
#include "panvo/runtime/context.hpp"
#include "sender.hpp"
#include "web_server.hpp"

namespace panvo::web_view {

class ClientSession;

/// Serves the topics of a runtime to the clients of a WebSocket server, and a page that shows them. Thread-safe.
class View {
 public:
  struct Settings {
    std::string host = "127.0.0.1";
    int port = 8765;
    std::string token;           ///< empty: none is asked for
    bool allow_control = false;  ///< clients may publish
    std::size_t max_clients = 8;
    std::size_t queue_bytes = 32'000'000;  ///< waiting messages of each client
    std::filesystem::path page;            ///< folder of the web page; empty: none
  };

  /// Throws ServerError if it cannot listen.
  View(runtime::Context& context, Settings settings);
  ~View();

  int port() const { return server_->port(); }

  /// Looks for new topics and for those that are gone, and tells the clients. Does nothing without a client.
  void refresh();

  // For the sessions of the clients:
  const Settings& settings() const { return settings_; }
  /// Identifies this run, so that a client that comes back knows whether ids still mean the same.
  const std::string& session() const { return session_; }
  const runtime::Logger& log() const { return context_.log(); }
  runtime::TopicAccess& topics() { return *topics_; }
  std::optional<runtime::TopicDescription> find(std::uint32_t channel) const;
  /// Tells the session of the server and its channels; later changes follow until leave().
  void join(ClientSession& session);
  void leave(ClientSession& session);

 private:
  bool is_known(const Credentials& credentials) const;
  std::optional<WebServer::Refusal> admit(const Credentials& credentials);
  HttpResponse get(const Credentials& credentials, const HttpRequest& request) const;
  void update();

  runtime::Context& context_;
  const Settings settings_;
  const std::string session_;
  const std::string cookie_name_, cookie_;  // let a browser in that has given the token
  const Page page_;
  const std::unique_ptr<runtime::TopicAccess> topics_;
  std::mutex update_mutex_;   // one update at a time
  mutable std::mutex mutex_;  // guards the next two
  ChannelTable table_;
  std::set<ClientSession*> sessions_;
  std::unique_ptr<WebServer> server_;  // last: its sessions use the members above
};

}  // namespace panvo::web_view
