// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "access.hpp"
#include "page.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/runtime/errors.hpp"
#include "view.hpp"

namespace panvo::web_view {
namespace {

constexpr std::chrono::milliseconds kRefreshPeriod{500};
constexpr std::chrono::milliseconds kTimePeriod{20};  // viewers place messages by the time last told

struct Parameters {
  std::string host = "127.0.0.1";
  int port = 8765;
  std::string token;
  bool allow_control = false;
  int max_clients = 8;
  int queue_mb = 32;
  std::string tls_certificate;
  std::string tls_key;
  std::string page;
  std::string assets;
  std::vector<std::string> allowed_origins;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field(&P::host, "host", "",
          "address to listen on; 0.0.0.0: all networks of this machine. Needs a token if not local");
    field(&P::port, "port", "", "TCP port; 0: any free one", 0, 65'535);
    field(&P::token, "token", "", "secret that clients must give: ws://HOST:PORT?token=TOKEN; empty: none");
    field(&P::allow_control, "allow_control", "", "clients may publish, set parameters and call services");
    field(&P::max_clients, "max_clients", "", "further clients are refused; each takes two threads", 1, 100);
    field(&P::queue_mb, "queue_mb", "MB",
          "messages waiting for one client; beyond it large messages are dropped, then the client is closed", 1, 1000);
    field(&P::allowed_origins, "allowed_origins", "",
          "web pages that may connect without a token: https://HOST, *: any; those of this machine and Foxglove's may");
    field.path(&P::tls_certificate, "tls_certificate",
               "PEM file: encrypts connections, https:// and wss://; empty: no");
    field.path(&P::tls_key, "tls_key", "PEM file of its private key, readable by its owner only");
    field.path(&P::assets, "assets", "folder of the files that viewers ask for as package://PACKAGE/FILE; empty: none");
    field.path(&P::page, "page", "folder of the web page; empty: the one that was built with panvo");
  }
};

/// Shows all topics to Foxglove and other viewers that speak its WebSocket protocol.
class WebViewComponent final : public runtime::Component {
 public:
  explicit WebViewComponent(runtime::Context& context) {
    const auto parameters = context.parameters<Parameters>();
    if (!is_local(parameters.host) && parameters.token.empty()) {
      throw runtime::ConfigError(context.name() + ": host " + parameters.host +
                                 " is reached from other machines; set the parameter token, or host 127.0.0.1");
    }
    View::Settings settings;
    settings.host = parameters.host;
    settings.port = parameters.port;
    settings.token = parameters.token;
    settings.allow_control = parameters.allow_control;
    settings.max_clients = static_cast<std::size_t>(parameters.max_clients);
    settings.queue_bytes = static_cast<std::size_t>(parameters.queue_mb) * 1'000'000;
    settings.allowed_origins = parameters.allowed_origins;
    settings.tls = {parameters.tls_certificate, parameters.tls_key};
    settings.assets = parameters.assets;
    settings.page = parameters.page.empty() ? default_page_folder() : std::filesystem::path(parameters.page);
    try {
      view_ = std::make_unique<View>(context, settings);
    } catch (const ServerError& error) {
      throw runtime::ConfigError(context.name() + ": " + error.what() + "; set the parameter port or host");
    } catch (const CertificateError& error) {
      throw runtime::ConfigError(context.name() + ": " + error.what());
    }
    context.every(kRefreshPeriod, [this] { view_->refresh(); });
    context.every(kTimePeriod, [this] { view_->tell_time(); });
    context.on_diagnostics([this] { return view_->diagnostics(); });
    context.log().info(
        "listening on ws{0}://{1}:{2}: open http{0}://{1}:{2} in a browser, or this address in Foxglove or "
        "Lichtblick as a Foxglove WebSocket",
        settings.tls.is_empty() ? "" : "s", parameters.host, view_->port());
  }

 private:
  std::unique_ptr<View> view_;
};

}  // namespace
}  // namespace panvo::web_view

namespace {
using panvo::web_view::WebViewComponent;
}
PANVO_REGISTER_COMPONENT(WebViewComponent)
