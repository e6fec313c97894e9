// SPDX-License-Identifier: Apache-2.0
#include "library_version.hpp"

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

const char* library_version() { return kFastDdsVersion; }

}  // namespace panvo::runtime::dds
