// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "file_guard.hpp"

namespace panvo::recorder {

/// Makes the folder of a bag, or empties one that is to be overwritten, and locks it for one writer. Throws BagError: it holds a bag that is not to be
/// overwritten or anything that is no part of one, another writer is at it, or it cannot be made.
Descriptor take_folder(const std::filesystem::path& bag, bool overwrite);

}  // namespace panvo::recorder
