// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/shm_leftovers.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace panvo::runtime {
namespace {

constexpr std::string_view kPrefix = "fast_datasharing_", kLockSuffix = "_el";
constexpr std::time_t kYouth_s = 5;

/// See shared_segment.hpp.
bool is_lock_of_a_segment(std::string_view name) { return name.starts_with(kPrefix) && name.ends_with(kLockSuffix); }

/// Checks whether the owner is gone. Holds the lock, so only one process cleans up at a time.
class Ownership {
 public:
  explicit Ownership(const std::filesystem::path& lock) : file_(open(lock.c_str(), O_RDONLY | O_CLOEXEC)) {
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
  std::vector<std::filesystem::path> locks;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (is_lock_of_a_segment(entry.path().filename().string())) locks.push_back(entry.path());
  }
  ShmLeftovers removed;
  for (const auto& lock : locks) {
    const Ownership owner(lock);
    if (!owner.is_left()) continue;
    const std::string name = lock.string();
    const std::filesystem::path segment = name.substr(0, name.size() - kLockSuffix.size());
    const std::uintmax_t size = std::filesystem::file_size(segment, error);
    const bool is_counted = !error && std::filesystem::remove(segment, error) && !error;
    std::filesystem::remove(lock, error);
    if (is_counted) removed = {removed.segments + 1, removed.bytes + size};
  }
  return removed;
}

}  // namespace panvo::runtime
