// SPDX-License-Identifier: Apache-2.0
#include "tls_client.hpp"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>

namespace panvo::web_view::test {
namespace {

template <class Object, auto kFree>
struct FreeBy {
  void operator()(Object* object) const { kFree(object); }
};
template <class Object, auto kFree>
using Handle = std::unique_ptr<Object, FreeBy<Object, kFree>>;
using Key = Handle<EVP_PKEY, EVP_PKEY_free>;
using Certificate = Handle<X509, X509_free>;
using File = Handle<std::FILE, std::fclose>;

}  // namespace

CertificateFiles make_certificate(const std::filesystem::path& folder, const std::string& name, long valid_s) {
  const Key key(EVP_EC_gen("P-256"));
  const Certificate certificate(X509_new());
  X509_set_version(certificate.get(), X509_VERSION_3);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), 1);
  constexpr long kDay = 86'400;
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -kDay);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), valid_s);
  X509_NAME* const subject = X509_get_subject_name(certificate.get());
  X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1,
                             0);
  X509_set_issuer_name(certificate.get(), subject);
  X509_set_pubkey(certificate.get(), key.get());
  X509_sign(certificate.get(), key.get(), EVP_sha256());
  const CertificateFiles files{folder / (name + ".cert.pem"), folder / (name + ".key.pem")};
  PEM_write_X509(File(std::fopen(files.certificate.c_str(), "w")).get(), certificate.get());
  PEM_write_PrivateKey(File(std::fopen(files.key.c_str(), "w")).get(), key.get(), nullptr, nullptr, 0, nullptr,
                       nullptr);
  ::chmod(files.key.c_str(), 0600);
  return files;
}

struct TlsStream::Handles {
  explicit Handles(int connected) : socket(connected) {}
  ~Handles() { ::close(socket); }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  const int socket;
  Handle<SSL_CTX, SSL_CTX_free> context{SSL_CTX_new(TLS_client_method())};
  Handle<SSL, SSL_free> tls{SSL_new(context.get())};
};

TlsStream::TlsStream(int port, int receive_buffer)
    : handles_(std::make_unique<Handles>(connected_socket(port, receive_buffer))) {
  std::signal(SIGPIPE, SIG_IGN);  // OpenSSL writes to sockets that the server has closed
  SSL_set_fd(handles_->tls.get(), handles_->socket);
  is_connected_ = SSL_connect(handles_->tls.get()) == 1;
}

TlsStream::~TlsStream() = default;

bool TlsStream::is_connected() const { return is_connected_; }

std::string TlsStream::server_name() const {
  const Certificate certificate(SSL_get1_peer_certificate(handles_->tls.get()));
  std::array<char, 100> name{};
  if (certificate)
    X509_NAME_get_text_by_NID(X509_get_subject_name(certificate.get()), NID_commonName, name.data(),
                              static_cast<int>(name.size()));
  return name.data();
}

bool TlsStream::has_ended_properly() const { return has_ended_properly_; }

void TlsStream::end() { SSL_shutdown(handles_->tls.get()); }

int TlsStream::own_port() const { return port_of(handles_->socket); }

long TlsStream::send(std::span<const std::uint8_t> bytes) {
  return is_connected_ ? SSL_write(handles_->tls.get(), bytes.data(), static_cast<int>(bytes.size())) : -1;
}

long TlsStream::receive(std::span<std::uint8_t> bytes) {
  if (!is_connected_) return -1;
  const int count = SSL_read(handles_->tls.get(), bytes.data(), static_cast<int>(bytes.size()));
  has_ended_properly_ = SSL_get_error(handles_->tls.get(), count) == SSL_ERROR_ZERO_RETURN;
  return count;
}

std::unique_ptr<ByteStream> tls_stream(int port, int receive_buffer) {
  return std::make_unique<TlsStream>(port, receive_buffer);
}

}  // namespace panvo::web_view::test
