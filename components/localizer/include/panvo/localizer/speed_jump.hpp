// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "panvo/localizer/odometry_buffer.hpp"

namespace panvo::localizer {

/// By how much the odometry's speed has changed between the latest images, if no vehicle can do that, m/s: odometry that
/// follows something else from one image to the next. Not by braking, nor by the jitter of stamps.
/// `agreed_ns`: panoramas confirm odometry up to this time.
std::optional<double> speed_jump_m_s(const OdometryBuffer& chain, std::optional<std::int64_t> agreed_ns);

}  // namespace panvo::localizer
