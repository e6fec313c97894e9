// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openssl/ssl.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tls_files.hpp"

namespace panvo::web_view {

struct FreeTls {
  void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
  void operator()(SSL* connection) const { SSL_free(connection); }
};
using TlsConnection = std::unique_ptr<SSL, FreeTls>;

/// Rules and certificate of a TLS server: TLS 1.2 or 1.3, without renegotiation and resumption.
class TlsContext {
 public:
  /// Throws CertificateError.
  explicit TlsContext(TlsFiles files);

  /// Reads the files again if they have changed. If they cannot be used, keeps the former certificate and returns why, once
  /// for each change.
  std::optional<std::string> refresh();

  /// The server's end of a connection on a socket that does not wait. Throws std::bad_alloc.
  TlsConnection connection(int socket) const;

 private:
  using Versions = std::array<std::array<std::int64_t, 4>, 2>;  // which state of each file was read

  Versions versions() const;

  const TlsFiles files_;
  Versions read_versions_;
  std::unique_ptr<SSL_CTX, FreeTls> context_;
};

}  // namespace panvo::web_view
