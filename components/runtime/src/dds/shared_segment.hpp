// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <filesystem>

namespace panvo::runtime::dds {

/// The memory that an endpoint of ours shares, `/dev/shm/fast_datasharing_ID`, marked as in use for as long as this lives: Fast DDS 2.9 leaves
/// it behind when its process is killed, and nothing about it tells that nobody is there any more. The mark is a lock on the file
/// `fast_datasharing_ID_el`, which remove_shm_leftovers() knows. To be destroyed after the endpoint, which removes its memory.
class SharedSegment {
 public:
  explicit SharedSegment(const eprosima::fastrtps::rtps::GUID_t& endpoint);
  ~SharedSegment();
  SharedSegment(const SharedSegment&) = delete;
  SharedSegment& operator=(const SharedSegment&) = delete;

  /// Whether Fast DDS has made it. It has not where /dev/shm is full, and where messages are encrypted.
  bool is_there() const noexcept { return lock_ >= 0; }

 private:
  const std::filesystem::path lock_file_;
  int lock_ = -1;
};

}  // namespace panvo::runtime::dds
