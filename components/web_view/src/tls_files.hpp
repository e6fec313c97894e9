// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>

namespace panvo::web_view {

/// What a server proves itself with; files in PEM format. Both empty: no TLS.
struct TlsFiles {
  std::filesystem::path certificate;  ///< followed by those of the authorities in between, if any
  std::filesystem::path key;

  bool is_empty() const { return certificate.empty() && key.empty(); }
};

/// Thrown if they cannot be used; names the parameter, the file and what to do.
class CertificateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace panvo::web_view
