// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <cstdint>
#include <filesystem>

namespace panvo::runtime::dds {

/// Whether /dev/shm has room for so many bytes. What is written where there is none ends the process (SIGBUS), so one asks before.
bool has_room_to_share(std::uint64_t bytes);

/// The memory that an endpoint of ours shares, `/dev/shm/fast_datasharing_ID`, reserved to the last byte, and marked as in use for as long as this lives: Fast DDS 2.9 leaves
/// it behind when its process is killed, and nothing about it tells that nobody is there any more. The mark is a lock on the file
/// `fast_datasharing_ID_el`, which remove_shm_leftovers() knows. To be destroyed after the endpoint, which removes its memory.
class SharedSegment {
 public:
  explicit SharedSegment(const eprosima::fastrtps::rtps::GUID_t& endpoint);
  ~SharedSegment();
  SharedSegment(const SharedSegment&) = delete;
  SharedSegment& operator=(const SharedSegment&) = delete;

  /// Whether Fast DDS has made it, and there is room for all of it.
  bool is_there() const noexcept { return is_reserved_; }

 private:
  const std::filesystem::path lock_file_;
  int lock_ = -1;
  bool is_reserved_ = false;
};

}  // namespace panvo::runtime::dds
