// SPDX-License-Identifier: Apache-2.0
#include "message_check.hpp"

#include <spdlog/fmt/fmt.h>

namespace panvo::runtime {

std::optional<std::string> problem_of(const Sample& sample, std::size_t max_bytes) {
  if (sample.received_size() > max_bytes) {
    return fmt::format("is larger than {:.6g} MB (max_message_mb)", 1e-6 * static_cast<double>(max_bytes));
  }
  try {
    const void* message = sample.message();
    return message && sample.type()->problem ? sample.type()->problem(message) : std::nullopt;
  } catch (const interfaces::DecodeError& error) {
    return error.what();
  }
}

}  // namespace panvo::runtime
