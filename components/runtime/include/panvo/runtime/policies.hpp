// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::runtime {

/// Access of service requests to a container and its components.
enum class ServiceAccess : std::uint8_t {
  kByHost,  ///< this host may control, others may read
  kOff,     ///< no services
  kLook,    ///< all may read parameters, states and loaded components
  kSteer    ///< all may also change them
};

/// Reaction to a component that throws in a live run. In replay it is stopped and never restarted.
enum class OnError : std::uint8_t {
  kIgnore,   ///< the component stops, the others continue
  kRestart,  ///< the component is restarted a few times, then as kIgnore
  kStop      ///< the container stops
};

}  // namespace panvo::runtime
