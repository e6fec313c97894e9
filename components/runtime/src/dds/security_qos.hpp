// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <string>

namespace panvo::runtime::dds {

/// Where the keys are and whose to use, as ROS 2's environment variables say: ROS_SECURITY_KEYSTORE, ROS_SECURITY_ENABLE ("true"),
/// ROS_SECURITY_STRATEGY ("Enforce"; else who has no keys goes without) and ROS_SECURITY_ENCLAVE_OVERRIDE.
struct SecuritySettings {
  bool is_enabled = false;
  bool is_enforced = false;
  std::string keystore;
  std::string enclave = "/panvo";  ///< begins with a slash, as ROS 2 writes it
};
SecuritySettings security_settings_from_environment();

/// Gives the participant its keys and what it may do (DDS Security: authentication, access control, encryption), from a keystore laid out as
/// SROS 2's, and marks it with its enclave. Returns whether it did. Throws ConfigError naming the file that is missing, or the private key that
/// others may read.
bool apply_security(const SecuritySettings& settings, eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace panvo::runtime::dds
