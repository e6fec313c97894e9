// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace panvo::runtime {

/// So often in a row may whoever reads a file fail before it is set aside.
inline constexpr int kMostFailures = 3;

/// To be called before a file is read that may be bad: counts this attempt in FILE.attempts beside it, which a crash leaves there. A file with which
/// kMostFailures attempts have failed is renamed to FILE.bad-1 (or -2 ...), which is returned. Where nothing can be written beside the file nothing
/// is counted. Throws std::runtime_error when a bad file cannot be renamed.
std::optional<std::filesystem::path> begin_trial(const std::filesystem::path& file);

/// It was read, and all went well.
void end_trial(const std::filesystem::path& file);

}  // namespace panvo::runtime
