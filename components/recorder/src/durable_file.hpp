// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace panvo::recorder {

/// Puts `content` in the place of a file in one step: whoever opens it sees the old content or the new, never a part.
/// `durable`: it has reached the disk when this returns. Throws BagError naming the file.
void replace_file(const std::filesystem::path& file, std::string_view content, bool durable);

/// Has the entries of a folder reach the disk; where the file system cannot, nothing happens.
void sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace panvo::recorder
