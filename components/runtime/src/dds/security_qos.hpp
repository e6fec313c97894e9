// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <string>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

/// Keystore and enclave from ROS 2's environment variables ROS_SECURITY_KEYSTORE, ROS_SECURITY_ENABLE ("true"),
/// ROS_SECURITY_STRATEGY ("Enforce"; otherwise processes without keys run unsecured) and ROS_SECURITY_ENCLAVE_OVERRIDE.
struct SecuritySettings {
  bool is_enabled = false;
  bool is_enforced = false;
  std::string keystore;
  std::string enclave = "/panvo";  ///< starts with a slash, as in ROS 2
};
SecuritySettings security_settings_from_environment();

/// Configures DDS Security (authentication, access control, encryption) from a keystore in SROS 2's layout, and marks
/// the participant with its enclave. Returns whether security was applied. Throws ConfigError naming a missing file or
/// a private key readable by others.
bool apply_security(const SecuritySettings& settings, fdds::DomainParticipantQos& qos);

}  // namespace panvo::runtime::dds
