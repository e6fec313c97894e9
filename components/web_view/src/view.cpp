// SPDX-License-Identifier: Apache-2.0
#include "view.hpp"

#include <chrono>
#include <random>
#include <utility>
#include <vector>

#include "access.hpp"
#include "client_session.hpp"

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
      topics_(context.topic_access()) {
  WebServer::Settings listening;
  listening.host = settings_.host;
  listening.port = settings_.port;
  listening.threads = static_cast<int>(settings_.max_clients) + kSpareThreads;
  listening.cookie = cookie_name_;
  listening.subprotocols = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
  server_ = std::make_unique<WebServer>(
      std::move(listening),
      WebServer::Callbacks{.admit = [this](const Credentials& credentials) { return admit(credentials); },
                           .open = [this](WebServer::Connection& connection) -> std::unique_ptr<WebServer::Session> {
                             return std::make_unique<ClientSession>(*this, connection);
                           },
                           .get = [this](const Credentials& credentials,
                                         const HttpRequest& request) { return get(credentials, request); }});
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
    response.headers.emplace_back("Set-Cookie", cookie_name_ + '=' + cookie_ + "; Path=/; HttpOnly; SameSite=Strict");
  return response;
}

std::optional<WebServer::Refusal> View::admit(const Credentials& credentials) {
  if (!is_known(credentials)) return WebServer::Refusal{401, kWrongToken};
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

void View::update() {
  const std::lock_guard updating(update_mutex_);
  const auto published = topics_->published();
  std::vector<std::shared_ptr<void>> ended;  // closed after the lock is released: closing waits for publishers
  const std::lock_guard lock(mutex_);
  const auto change = table_.update(published);
  if (table_.left_out() > 0)
    log().warn_throttled("channels", "{} topics are not offered: there are more than {}", table_.left_out(),
                         ChannelTable::kMaxChannels);
  for (ClientSession* session : sessions_) session->tell(change, ended);
}

std::optional<runtime::TopicDescription> View::find(std::uint32_t channel) const {
  const std::lock_guard lock(mutex_);
  const auto* topic = table_.find(channel);
  return topic ? std::optional(*topic) : std::nullopt;
}

void View::join(ClientSession& session) {
  update();
  const std::lock_guard lock(mutex_);
  session.welcome(table_.channels());
  sessions_.insert(&session);
}

void View::leave(ClientSession& session) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(&session);
}

}  // namespace panvo::web_view
