// SPDX-License-Identifier: Apache-2.0
#include "enclave.hpp"

#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace panvo::runner {
namespace {

constexpr const char* kOverride = "ROS_SECURITY_ENCLAVE_OVERRIDE";

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Makes a word of an enclave name; invalid characters become underscores.
std::string word(std::string text) {
  for (char& letter : text) {
    const bool is_fine =
        (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
    if (!is_fine) letter = '_';
  }
  return text;
}

}  // namespace

void use_enclave_of(const std::string& system_file, const std::string& container) {
  if (variable("ROS_SECURITY_ENABLE") != "true" || !variable(kOverride).empty()) return;
  const auto enclave =
      std::filesystem::path("/") / word(std::filesystem::path(system_file).stem().string()) / word(container);
  const auto folder = std::filesystem::path(variable("ROS_SECURITY_KEYSTORE")) / "enclaves" / enclave.relative_path();
  std::error_code error;
  if (std::filesystem::exists(folder / "key.pem", error)) setenv(kOverride, enclave.c_str(), 1);
}

}  // namespace panvo::runner
