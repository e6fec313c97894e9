// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "web_socket_client.hpp"

namespace panvo::web_view::test {

/// Files of a certificate and its key.
struct CertificateFiles {
  std::filesystem::path certificate, key;
};

/// Makes a key, and a certificate for `name` that it signs itself, valid for so many seconds from now.
CertificateFiles make_certificate(const std::filesystem::path& folder, const std::string& name, long valid_s = 3600);

/// A TLS connection to a port of this machine that accepts any certificate.
class TlsStream final : public ByteStream {
 public:
  explicit TlsStream(int port, int receive_buffer = 0);
  ~TlsStream() override;

  /// Whether there was a handshake; otherwise nothing is sent or received.
  bool is_connected() const;
  /// The name of the server's certificate.
  std::string server_name() const;
  /// Whether the last receive() found the end that the server tells of, rather than a broken connection.
  bool has_ended_properly() const;
  /// Tells the server that nothing more will be sent.
  void end();
  int own_port() const override;
  long send(std::span<const std::uint8_t> bytes) override;
  long receive(std::span<std::uint8_t> bytes) override;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  bool is_connected_ = false, has_ended_properly_ = false;
};

/// For WebSocketClient::Request and http_answer().
std::unique_ptr<ByteStream> tls_stream(int port, int receive_buffer);

}  // namespace panvo::web_view::test
