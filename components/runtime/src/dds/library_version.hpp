// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::runtime::dds {

/// Version of Fast DDS that this library is compiled against: "2.9.1".
const char* library_version();

}  // namespace panvo::runtime::dds
