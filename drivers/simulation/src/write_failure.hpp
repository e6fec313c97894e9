// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace panvo::simulation {

/// Throws what a person can do about a file that could not be written, with the operating system's reason (errno).
[[noreturn]] inline void fail_to_write(const std::filesystem::path& file) {
  throw std::runtime_error(fmt::format("{}: cannot be written ({}); free space there or name another folder",
                                       file.string(), std::strerror(errno)));
}

}  // namespace panvo::simulation
