// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::runtime {

/// What requests by service may do to a container and its components.
enum class ServiceAccess : std::uint8_t {
  kByHost,  ///< who is on this host may steer, others may look
  kOff,     ///< there are no services
  kLook,    ///< parameters, states and what is loaded may be read
  kSteer    ///< and be changed
};

/// What becomes of a component that throws, in a live run; in replay it is stopped and never made anew.
enum class OnError : std::uint8_t {
  kIgnore,   ///< it is stopped, the others go on
  kRestart,  ///< it is made anew, a few times; then as kIgnore
  kStop      ///< the container stops
};

}  // namespace panvo::runtime
