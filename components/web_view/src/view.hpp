// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "image_compressor.hpp"
#include "page.hpp"
#include "panvo/runtime/context.hpp"
#include "parameter_access.hpp"
#include "server_message.hpp"
#include "web_server.hpp"

namespace panvo::web_view {

class ClientSession;

/// Serves the topics of a runtime to the clients of a WebSocket server, and a page that shows them. Thread-safe.
class View {
 public:
  struct Settings {
    std::string host = "127.0.0.1";
    int port = 8765;
    std::string token;                         ///< empty: none is asked for
    std::vector<std::string> allowed_origins;  ///< of web pages that may read without a token
    bool allow_control = false;                ///< clients may publish, set parameters and call services
    std::size_t max_clients = 8;
    std::size_t queue_bytes = 32'000'000;  ///< waiting messages of each client
    TlsFiles tls;                          ///< none: connections are not encrypted
    std::filesystem::path page;            ///< folder of the web page; empty: none
    std::filesystem::path assets;          ///< folder of package:// assets; empty: none
  };

  /// Throws ServerError if it cannot listen, CertificateError.
  View(runtime::Context& context, Settings settings);
  ~View();

  int port() const { return server_->port(); }

  /// Looks for new topics, services and links and for those that are gone, and tells the clients. Does nothing without
  /// a client.
  void refresh();
  /// Tells the clients the time, if it is not that of the system: of a recording or a simulation; and how it is played.
  void tell_time();
  /// For /diagnostics.
  runtime::DiagnosticValues diagnostics() const;

  // For the sessions of the clients:
  /// The time of a recording or a simulation; nullopt: that of the system.
  std::optional<std::int64_t> time_ns() const;
  const Settings& settings() const { return settings_; }
  /// Of the player of this process.
  runtime::Playback& playback() { return context_.playback(); }
  /// Tells the other clients that `by` has moved what is played.
  void tell_playback(const ClientSession* by);
  /// Identifies this run, so that a client that comes back knows whether ids still mean the same.
  const std::string& session() const { return session_; }
  const runtime::Logger& log() const { return context_.log(); }
  runtime::TopicAccess& topics() { return *topics_; }
  const ParameterAccess& parameters() const { return parameters_; }
  ImageCompressor& compressor() { return compressor_; }
  std::optional<runtime::TopicDescription> find(std::uint32_t channel) const;
  std::optional<runtime::ServiceDescription> find_service(std::uint32_t service) const;
  /// Tells the session of the server and its channels; later changes follow until leave().
  void join(ClientSession& session);
  void leave(ClientSession& session);

 private:
  bool is_known(const Credentials& credentials) const;
  std::optional<WebServer::Refusal> admit(const Credentials& credentials);
  HttpResponse get(const Credentials& credentials, const HttpRequest& request) const;
  void update();
  std::vector<runtime::ServiceDescription> callable() const;
  void follow_clock(const std::vector<runtime::TopicDescription>& published);

  runtime::Context& context_;
  const Settings settings_;
  const std::string session_;
  const std::string cookie_name_, cookie_;  // let a browser in that has given the token
  const Page page_;
  const std::unique_ptr<runtime::TopicAccess> topics_;
  const ParameterAccess parameters_;
  ImageCompressor compressor_;
  std::atomic<std::int64_t> clock_ns_ = 0;  // of /clock; 0: none
  std::shared_ptr<void> clock_;             // reads it; used with update_mutex_ locked
  std::mutex update_mutex_;                 // one update at a time
  mutable std::mutex mutex_;                // guards the next five
  ChannelTable channels_;
  ServiceTable services_;
  std::set<ClientSession*> sessions_;
  std::uint64_t clients_before_ = 0, dropped_before_ = 0;  // of clients that have left
  std::unique_ptr<WebServer> server_;                      // last: its sessions use the members above
};

}  // namespace panvo::web_view
