// SPDX-License-Identifier: Apache-2.0
#include "tls_context.hpp"

#include <openssl/err.h>
#include <openssl/x509.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <new>
#include <utility>

namespace panvo::web_view {
namespace {

using ContextHandle = std::unique_ptr<SSL_CTX, FreeTls>;

constexpr const char* kCertificate = "tls_certificate";
constexpr const char* kKey = "tls_key";

[[noreturn]] void fail(const char* parameter, const std::filesystem::path& file, const std::string& why) {
  throw CertificateError(std::string(parameter) + " " + file.string() + ": " + why);
}

/// What OpenSSL last complained of.
std::string reason() {
  const char* const text = ERR_reason_error_string(ERR_peek_last_error());
  return text ? text : "unknown reason";
}

void require_readable(const char* parameter, const std::filesystem::path& file) {
  if (::access(file.c_str(), R_OK) != 0)
    fail(parameter, file, std::string("cannot be read: ") + std::strerror(errno) + "; name a file in PEM format");
}

/// Anyone who can read the key can act as this server.
void refuse_if_others_may_read(const std::filesystem::path& key) {
  using std::filesystem::perms;
  constexpr perms kOthers = perms::group_all | perms::others_all;
  if ((std::filesystem::status(key).permissions() & kOthers) == perms::none) return;
  fail(kKey, key,
       "this private key is readable by other users; run `chmod 600 " + key.string() +
           "`, and make a new one if somebody may have read it");
}

/// "2026-11-30 12:00 UTC".
std::string text_of(const ASN1_TIME* time) {
  std::tm parts{};
  std::array<char, 32> text{};
  if (ASN1_TIME_to_tm(time, &parts) != 1) return "an unknown time";
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &parts);
  return text.data();
}

/// A key with a passphrase is an error, not a question on the terminal.
int refuse_passphrase(char*, int, int, void*) { return -1; }

void read_certificate(SSL_CTX* context, const std::filesystem::path& file) {
  require_readable(kCertificate, file);
  if (SSL_CTX_use_certificate_chain_file(context, file.c_str()) != 1)
    fail(kCertificate, file, "is not a usable certificate in PEM format (" + reason() + ")");
  const auto* const end = X509_get0_notAfter(SSL_CTX_get0_certificate(context));
  if (X509_cmp_current_time(end) < 0)
    fail(kCertificate, file, "expired on " + text_of(end) + "; renew it, or correct the clock of this computer");
}

void read_key(SSL_CTX* context, const TlsFiles& files) {
  require_readable(kKey, files.key);
  refuse_if_others_may_read(files.key);
  SSL_CTX_set_default_passwd_cb(context, refuse_passphrase);
  const bool is_read = SSL_CTX_use_PrivateKey_file(context, files.key.c_str(), SSL_FILETYPE_PEM) == 1;
  if (!is_read && ERR_GET_REASON(ERR_peek_last_error()) != X509_R_KEY_VALUES_MISMATCH)
    fail(kKey, files.key, "is not a usable private key in PEM format without a passphrase (" + reason() + ")");
  if (!is_read || SSL_CTX_check_private_key(context) != 1)
    fail(kKey, files.key,
         "is not the key of " + std::string(kCertificate) + " " + files.certificate.string() +
             "; name files that were made together");
}

ContextHandle load(const TlsFiles& files) {
  if (files.key.empty()) fail(kCertificate, files.certificate, std::string("set ") + kKey + ", too");
  if (files.certificate.empty()) fail(kKey, files.key, std::string("set ") + kCertificate + ", too");
  ERR_clear_error();
  ContextHandle context(SSL_CTX_new(TLS_server_method()));
  if (!context) throw std::bad_alloc();
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(context.get(), "ECDHE+AESGCM:ECDHE+CHACHA20");  // of TLS 1.2: with forward secrecy
  SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_NO_TICKET);
  SSL_CTX_set_num_tickets(context.get(), 0);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(context.get(),
                   SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER | SSL_MODE_RELEASE_BUFFERS);
  read_certificate(context.get(), files.certificate);
  read_key(context.get(), files);
  return context;
}

}  // namespace

TlsContext::TlsContext(TlsFiles files) : files_(std::move(files)), read_versions_(versions()), context_(load(files_)) {}

TlsContext::Versions TlsContext::versions() const {
  Versions versions{};  // zeros for a file that is not there
  for (std::size_t i = 0; i < versions.size(); ++i) {
    struct stat status {};
    if (::stat((i == 0 ? files_.certificate : files_.key).c_str(), &status) != 0) continue;
    versions[i] = {static_cast<std::int64_t>(status.st_ino), status.st_size, status.st_mtim.tv_sec,
                   status.st_mtim.tv_nsec};
  }
  return versions;
}

std::optional<std::string> TlsContext::refresh() {
  const auto now = versions();
  if (now == read_versions_) return std::nullopt;
  read_versions_ = now;
  try {
    context_ = load(files_);
    return std::nullopt;
  } catch (const CertificateError& error) {
    return std::string(error.what()) + "; the former certificate stays in use";
  }
}

TlsConnection TlsContext::connection(int socket) const {
  TlsConnection connection(SSL_new(context_.get()));
  if (!connection || SSL_set_fd(connection.get(), socket) != 1) throw std::bad_alloc();
  SSL_set_accept_state(connection.get());
  return connection;
}

}  // namespace panvo::web_view
