// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/shm_leftovers.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace panvo::runtime {
namespace {

constexpr std::string_view kPrefix = "fast_datasharing_", kMarkSuffix = "_el";
constexpr std::time_t kYouth_s = 5;

/// See SharingMark.
bool is_mark(std::string_view name) { return name.starts_with(kPrefix) && name.ends_with(kMarkSuffix); }

/// Checks whether the owner is gone. Holds its lock, so only one process cleans up at a time.
class Ownership {
 public:
  explicit Ownership(const std::filesystem::path& mark) : file_(open(mark.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat state {};
    is_left_ = file_ >= 0 && fstat(file_, &state) == 0 && std::time(nullptr) - state.st_ctime >= kYouth_s &&
               flock(file_, LOCK_EX | LOCK_NB) == 0;
  }
  ~Ownership() {
    if (file_ >= 0) close(file_);
  }
  Ownership(const Ownership&) = delete;
  Ownership& operator=(const Ownership&) = delete;

  bool is_left() const noexcept { return is_left_; }

 private:
  const int file_;
  bool is_left_ = false;
};

}  // namespace

ShmLeftovers remove_shm_leftovers(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::string> marks, segments;  // paths
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with(kPrefix)) (is_mark(name) ? marks : segments).push_back(entry.path().string());
  }
  ShmLeftovers removed;
  for (const auto& mark : marks) {
    const Ownership owner(mark);
    if (!owner.is_left()) continue;
    const auto participant = std::string_view(mark).substr(0, mark.size() - kMarkSuffix.size());
    for (const auto& segment : segments) {
      if (!segment.starts_with(participant)) continue;
      const std::uintmax_t size = std::filesystem::file_size(segment, error);
      const bool is_counted = !error && std::filesystem::remove(segment, error) && !error;
      if (is_counted) removed = {removed.segments + 1, removed.bytes + size};
    }
    std::filesystem::remove(mark, error);
  }
  return removed;
}

}  // namespace panvo::runtime
