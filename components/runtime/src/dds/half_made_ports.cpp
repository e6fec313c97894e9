// SPDX-License-Identifier: Apache-2.0
#include "half_made_ports.hpp"

#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace panvo::runtime::dds {
namespace {

constexpr std::string_view kPrefix = "fastrtps_port";
constexpr std::uint32_t kMade = 2;         // first word of a segment that Boost.Interprocess has made to the end
constexpr std::chrono::seconds kYouth{5};  // making one takes milliseconds

bool is_port(const std::string& name) {
  return name.starts_with(kPrefix) && name.size() > kPrefix.size() &&
         name.find_first_not_of("0123456789", kPrefix.size()) == std::string::npos;
}

bool is_made(const std::filesystem::path& file) {
  std::uint32_t state = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return true;  // another user's, or gone by now
  stream.read(reinterpret_cast<char*>(&state), sizeof(state));
  return stream && state == kMade;
}

bool is_young(const std::filesystem::path& file) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  return error || std::filesystem::file_time_type::clock::now() - written < kYouth;
}

}  // namespace

std::size_t remove_half_made_ports(const std::filesystem::path& folder) {
  std::size_t removed = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (!is_port(entry.path().filename().string()) || is_made(entry.path()) || is_young(entry.path())) continue;
    std::error_code failed;
    if (std::filesystem::remove(entry.path(), failed) && !failed) ++removed;
  }
  return removed;
}

}  // namespace panvo::runtime::dds
