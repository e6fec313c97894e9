// SPDX-License-Identifier: Apache-2.0
#include "security_qos.hpp"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "environment_variable.hpp"
#include "fast_dds.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime::dds {
namespace {

#if defined(HAVE_SECURITY) && HAVE_SECURITY
constexpr bool kIsBuiltIn = true;
#else
constexpr bool kIsBuiltIn = false;
#endif

struct Property {
  const char *name, *file;
};
constexpr const char* kPrivateKey = "key.pem";
/// Property names of an enclave's files in the DDS Security specification.
constexpr std::array<Property, 6> kFiles{
    {{"dds.sec.auth.builtin.PKI-DH.identity_ca", "identity_ca.cert.pem"},
     {"dds.sec.auth.builtin.PKI-DH.identity_certificate", "cert.pem"},
     {"dds.sec.auth.builtin.PKI-DH.private_key", kPrivateKey},
     {"dds.sec.access.builtin.Access-Permissions.permissions_ca", "permissions_ca.cert.pem"},
     {"dds.sec.access.builtin.Access-Permissions.governance", "governance.p7s"},
     {"dds.sec.access.builtin.Access-Permissions.permissions", "permissions.p7s"}}};
/// Revoked certificates; missing until one is revoked.
constexpr Property kRevoked{"dds.sec.auth.builtin.PKI-DH.identity_crl", "crl.pem"};
constexpr std::array<std::pair<const char*, const char*>, 3> kPlugins{
    {{"dds.sec.auth.plugin", "builtin.PKI-DH"},
     {"dds.sec.access.plugin", "builtin.Access-Permissions"},
     {"dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC"}}};

/// Anyone who can read the key can act as its owner.
void refuse_if_others_may_read(const std::filesystem::path& key) {
  using std::filesystem::perms;
  constexpr perms kOthers = perms::group_all | perms::others_all;
  if ((std::filesystem::status(key).permissions() & kOthers) == perms::none) return;
  throw ConfigError(
      fmt::format("{0}: this private key is readable by other users; run `chmod 600 {0}`, and create new keys if "
                  "somebody may have read it",
                  key.string()));
}

}  // namespace

SecuritySettings security_settings_from_environment() {
  SecuritySettings settings;
  settings.is_enabled = environment_variable("ROS_SECURITY_ENABLE") == "true";
  settings.is_enforced = environment_variable("ROS_SECURITY_STRATEGY") == "Enforce";
  settings.keystore = environment_variable("ROS_SECURITY_KEYSTORE");
  if (const auto enclave = environment_variable("ROS_SECURITY_ENCLAVE_OVERRIDE"); !enclave.empty()) {
    settings.enclave = enclave.front() == '/' ? enclave : "/" + enclave;
  }
  return settings;
}

bool apply_security(const SecuritySettings& settings, fdds::DomainParticipantQos& qos) {
  if (!settings.is_enabled) return false;
  if (!kIsBuiltIn)
    throw ConfigError("security is requested, but this Fast DDS was built without it; use a build with -DSECURITY=ON");
  if (settings.keystore.empty())
    throw ConfigError("ROS_SECURITY_ENABLE is true, but ROS_SECURITY_KEYSTORE is not set; set both, or neither");
  const auto folder = std::filesystem::path(settings.keystore) / "enclaves" / settings.enclave.substr(1);
  if (!settings.is_enforced && !std::filesystem::exists(folder)) return false;
  auto& properties = qos.properties().properties();
  for (const auto& [name, file] : kFiles) {
    const auto path = folder / file;
    if (!std::ifstream(path)) {
      throw ConfigError(fmt::format("{}: cannot be read; create it with `panvo secure {} {}`, or use another enclave",
                                    path.string(), settings.keystore, settings.enclave));
    }
    if (std::string_view(file) == kPrivateKey) refuse_if_others_may_read(path);
    properties.emplace_back(name, "file://" + std::filesystem::absolute(path).string());
  }
  if (const auto revoked = folder / kRevoked.file; std::ifstream(revoked))
    properties.emplace_back(kRevoked.name, "file://" + std::filesystem::absolute(revoked).string());
  for (const auto& [name, plugin] : kPlugins) properties.emplace_back(name, plugin);
  const std::string enclave = "enclave=" + settings.enclave + ";";
  qos.user_data().setValue({enclave.c_str(), enclave.c_str() + enclave.size() + 1});  // rmw also sends the zero
  return true;
}

}  // namespace panvo::runtime::dds
