// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace panvo::runtime {

/// Number of consecutive failed attempts after which a file is set aside.
inline constexpr int kMaxFailures = 3;

/// Call before reading a file that may be bad: counts the attempt in FILE.attempts, which remains after a crash. After
/// kMaxFailures failed attempts the file is renamed to FILE.bad-1 (or -2 ...), which is returned. Nothing is counted
/// if the folder is not writable. Throws std::runtime_error if a bad file cannot be renamed.
std::optional<std::filesystem::path> begin_trial(const std::filesystem::path& file);

/// Call after a successful attempt: resets the count.
void end_trial(const std::filesystem::path& file);

}  // namespace panvo::runtime
