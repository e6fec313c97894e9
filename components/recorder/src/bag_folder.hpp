// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "file_guard.hpp"

namespace panvo::recorder {

/// Creates the folder of a bag, or empties an existing one if `overwrite`, and locks it for one writer. Throws BagError
/// if it is not empty and `overwrite` is false, if it holds anything that is not part of a bag, if another writer has
/// locked it, or if it cannot be created.
Descriptor take_folder(const std::filesystem::path& bag, bool overwrite);

}  // namespace panvo::recorder
