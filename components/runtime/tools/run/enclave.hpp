// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::runtime {

/// Has this process use the keys that `panvo secure --system` made for that container of that system, if the keystore in force has them and no
/// other enclave is asked for. To be called before other threads are started.
void use_enclave_of(const std::string& system_file, const std::string& container);

}  // namespace panvo::runtime
