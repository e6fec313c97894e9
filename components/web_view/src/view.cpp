// SPDX-License-Identifier: Apache-2.0
#include "view.hpp"

#include <algorithm>
#include <chrono>
#include <random>
#include <utility>
#include <vector>

#include "access.hpp"
#include "client_session.hpp"
#include "panvo/interfaces/node_topics.hpp"

namespace panvo::web_view {
namespace {

constexpr const char* kWrongToken = "the token is missing or wrong: open http://HOST:PORT/?token=TOKEN";
constexpr int kSpareThreads = 4;  // send files, and answer clients beyond the allowed number

std::string unique_text() { return std::to_string(std::chrono::system_clock::now().time_since_epoch().count()); }

/// 128 random bits.
std::string secret_text() {
  std::random_device random;
  std::string text;
  for (int i = 0; i < 4; ++i) text += std::to_string(random()) + "_";
  return text;
}

}  // namespace

View::View(runtime::Context& context, Settings settings)
    : context_(context),
      settings_(std::move(settings)),
      session_(unique_text()),
      cookie_name_("panvo_view_" + std::to_string(settings_.port)),
      cookie_(secret_text()),
      page_(settings_.page),
      topics_(context.topic_access()),
      parameters_(*topics_) {
  WebServer::Settings listening;
  listening.host = settings_.host;
  listening.port = settings_.port;
  listening.threads = static_cast<int>(settings_.max_clients) + kSpareThreads;
  listening.cookie = cookie_name_;
  listening.tls = settings_.tls;
  listening.subprotocols = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
  server_ = std::make_unique<WebServer>(
      std::move(listening),
      WebServer::Callbacks{.admit = [this](const Credentials& credentials) { return admit(credentials); },
                           .open = [this](WebServer::Connection& connection) -> std::unique_ptr<WebServer::Session> {
                             return std::make_unique<ClientSession>(*this, connection);
                           },
                           .get = [this](const Credentials& credentials,
                                         const HttpRequest& request) { return get(credentials, request); },
                           .warn = [this](const std::string& kind,
                                          const std::string& text) { log().warn_throttled(kind, "{}", text); }});
}

View::~View() = default;

bool View::is_known(const Credentials& credentials) const {
  if (settings_.token.empty() || is_equal_secret(settings_.token, credentials.token) ||
      is_equal_secret(cookie_, credentials.cookie))
    return true;
  log().warn_throttled("token", "a client without the right token was refused");
  return false;
}

HttpResponse View::get(const Credentials& credentials, const HttpRequest& request) const {
  if (!is_known(credentials)) return {401, "text/plain; charset=utf-8", std::string(kWrongToken) + '\n', {}};
  auto response = page_.get(request);
  // Browsers do not repeat the token when they ask for the scripts of the page.
  if (!settings_.token.empty())
    response.headers.emplace_back("Set-Cookie", cookie_name_ + '=' + cookie_ + "; Path=/; HttpOnly; SameSite=Strict" +
                                                    (settings_.tls.is_empty() ? "" : "; Secure"));
  return response;
}

std::optional<WebServer::Refusal> View::admit(const Credentials& credentials) {
  if (!is_known(credentials)) return WebServer::Refusal{401, kWrongToken};
  if (settings_.token.empty() && !is_trusted_origin(credentials.origin, settings_.allowed_origins)) {
    log().warn_throttled("origin", "a web page of {} was refused: add it to allowed_origins, or set a token",
                         credentials.origin);
    return WebServer::Refusal{403, "web pages of this origin may not connect: see allowed_origins of the web view"};
  }
  const std::lock_guard lock(mutex_);
  if (sessions_.size() < settings_.max_clients) return std::nullopt;
  log().warn_throttled("max_clients", "a client was refused: max_clients is {}", settings_.max_clients);
  return WebServer::Refusal{503, "there are too many clients"};
}

void View::refresh() {
  {
    const std::lock_guard lock(mutex_);
    if (sessions_.empty()) return;
  }
  update();
}

/// Services whose types are known here, as others cannot be called.
std::vector<runtime::ServiceDescription> View::callable() const {
  auto services = settings_.allow_control ? topics_->services() : std::vector<runtime::ServiceDescription>();
  std::erase_if(services,
                [](const auto& service) { return !interfaces::find_message_type(service.type_name + "_Request"); });
  return services;
}

void View::update() {
  const std::lock_guard updating(update_mutex_);
  const auto published = compressor_.offer(topics_->published());
  follow_clock(published);
  const auto callable_now = callable();
  std::vector<std::shared_ptr<void>> ended;  // closed after the lock is released: closing waits for publishers
  const std::lock_guard lock(mutex_);
  const auto change = channels_.update(published);
  const auto services = services_.update(callable_now);
  if (channels_.left_out() > 0)
    log().warn_throttled("channels", "{} topics are not offered: there are more than {}", channels_.left_out(),
                         ChannelTable::kMax);
  const bool wants_graph = std::ranges::any_of(sessions_, &ClientSession::wants_graph);
  const auto graph = wants_graph ? connection_graph_of(topics_->nodes()) : ConnectionGraph();
  for (ClientSession* session : sessions_) {
    session->tell(change, ended);
    session->tell(services);
    session->tell(graph);
    session->tell_drops();
  }
}

/// Reads /clock while somebody publishes it.
void View::follow_clock(const std::vector<runtime::TopicDescription>& published) {
  const auto found = std::ranges::find(published, topics::kClock.name, &runtime::TopicDescription::name);
  if (found == published.end()) {
    clock_.reset();
    clock_ns_ = 0;
  } else if (!clock_) {
    clock_ = topics_->read(*found, [this](const runtime::SamplePtr& sample) {
      if (const void* clock = sample->type() ? sample->message() : nullptr)
        clock_ns_ = sample->type()->stamp_ns(clock).value_or(0);
    });
  }
}

std::optional<std::int64_t> View::time_ns() const {
  if (const auto played_ns = context_.playback().stamp_ns()) return played_ns;
  const std::int64_t clock_ns = clock_ns_;
  return clock_ns == 0 ? std::nullopt : std::optional(clock_ns);
}

void View::tell_time() {
  const std::lock_guard lock(mutex_);
  for (ClientSession* session : sessions_) {
    session->tell_time();
    session->tell_playback(false);
  }
}

void View::tell_playback(const ClientSession* by) {
  const std::lock_guard lock(mutex_);
  for (ClientSession* session : sessions_) {
    if (session != by) session->tell_playback(true);
  }
}

runtime::DiagnosticValues View::diagnostics() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t dropped = dropped_before_;
  runtime::DiagnosticValues values;
  for (const ClientSession* session : sessions_) {
    dropped += session->dropped();
    values.emplace_back("client " + session->address(), std::to_string(session->subscriptions()) + " subscriptions, " +
                                                            std::to_string(session->dropped()) + " messages dropped");
  }
  values.emplace_back("clients", std::to_string(sessions_.size()) + " now, " + std::to_string(clients_before_) +
                                     " before, " + std::to_string(dropped) + " messages dropped");
  return values;
}

std::optional<runtime::TopicDescription> View::find(std::uint32_t channel) const {
  const std::lock_guard lock(mutex_);
  const auto* topic = channels_.find(channel);
  return topic ? std::optional(*topic) : std::nullopt;
}

std::optional<runtime::ServiceDescription> View::find_service(std::uint32_t id) const {
  const std::lock_guard lock(mutex_);
  const auto* service = services_.find(id);
  return service ? std::optional(*service) : std::nullopt;
}

void View::join(ClientSession& session) {
  update();
  const std::lock_guard lock(mutex_);
  session.welcome(time_ns().has_value());
  session.tell_time();
  std::vector<std::shared_ptr<void>> none;
  session.tell(ChannelTable::Change{channels_.all(), {}}, none);
  session.tell(ServiceTable::Change{services_.all(), {}});
  sessions_.insert(&session);
}

void View::leave(ClientSession& session) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(&session);
  ++clients_before_;
  dropped_before_ += session.dropped();
}

}  // namespace panvo::web_view
