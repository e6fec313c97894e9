// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fault.hpp"

/// Kinds of faults by affected part; fault_kinds() returns all.
namespace panvo::test {

std::vector<FaultKind> image_kinds();
std::vector<FaultKind> optics_kinds();
std::vector<FaultKind> timing_kinds();
std::vector<FaultKind> panorama_kinds();
std::vector<FaultKind> calibration_kinds();
std::vector<FaultKind> message_kinds();
std::vector<FaultKind> mixed_kinds();

}  // namespace panvo::test
