// SPDX-License-Identifier: Apache-2.0
// Takes the place of tls_front.cpp where OpenSSL is not installed.
#include "tls_front.hpp"

namespace panvo::web_view {

class TlsFront::Loop {};

TlsFront::TlsFront(Settings, RelayedPeers&, Warn) {
  throw CertificateError("tls_certificate: this build of panvo has no TLS: install libssl-dev and build again");
}

TlsFront::~TlsFront() = default;

int TlsFront::port() const { return 0; }

}  // namespace panvo::web_view
