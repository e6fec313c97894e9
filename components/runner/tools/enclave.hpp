// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::runner {

/// Selects the keys that `panvo secure --system` created for that container, if the keystore has them and no other
/// enclave is set. Call before starting threads.
void use_enclave_of(const std::string& system_file, const std::string& container);

}  // namespace panvo::runner
