// SPDX-License-Identifier: Apache-2.0
#include "library_version.hpp"

#include <fastrtps/config.h>

namespace panvo::runtime::dds {

const char* library_version() { return FASTRTPS_VERSION_STR; }

}  // namespace panvo::runtime::dds
