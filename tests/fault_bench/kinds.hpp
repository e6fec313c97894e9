// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fault.hpp"

/// The kinds by what they spoil; fault_kinds() is all of them.
namespace panvo::test {

std::vector<FaultKind> image_kinds();
std::vector<FaultKind> optics_kinds();
std::vector<FaultKind> timing_kinds();
std::vector<FaultKind> panorama_kinds();
std::vector<FaultKind> calibration_kinds();
std::vector<FaultKind> message_kinds();
std::vector<FaultKind> mixed_kinds();

}  // namespace panvo::test
