// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace panvo::recorder {

/// Atomically replaces a file by one with `content`: readers see the old or the new content. `durable`: waits until the
/// content is on disk. Throws BagError that names the file.
void replace_file(const std::filesystem::path& file, std::string_view content, bool durable);

/// Syncs the entries of a folder to disk. Does nothing if the file system does not support it.
void sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace panvo::recorder
