// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::landmarks {

/// The smallest spread that differences of responses are divided by: smaller ones are noise.
inline constexpr float kMinFeatureSpread = 0.05F;

}  // namespace panvo::landmarks
