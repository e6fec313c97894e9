// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace panvo::web_view {

/// What a client says of itself. Each is empty if it says nothing.
struct Credentials {
  std::string token;   ///< of the address, or of the header Authorization
  std::string cookie;  ///< that this server has set
  std::string origin;  ///< of the web page that asks, "https://example.org"
};

/// A GET request for a file.
struct HttpRequest {
  std::string path;           ///< decoded, begins with a slash
  std::string host;           ///< header Host: what the client calls this server
  std::string if_none_match;  ///< header of this name: the version that the client has
  bool is_secure = false;     ///< came by TLS
};

struct HttpResponse {
  int status = 200;
  std::string content_type;
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;  ///< further ones
};

}  // namespace panvo::web_view
