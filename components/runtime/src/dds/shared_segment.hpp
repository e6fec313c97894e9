// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

/// Whether /dev/shm has room for `bytes`. Writing without room ends the process (SIGBUS), so check first.
bool has_room_to_share(std::uint64_t bytes);

/// The shared memory of an endpoint, `/dev/shm/fast_datasharing_ID`: reserves all its pages and marks it as in use for
/// the lifetime of this object. If its process is killed, Fast DDS 2.9 leaves the memory behind without a sign that the
/// owner is gone. The mark is a lock on the file `fast_datasharing_ID_el`, which remove_shm_leftovers() checks. Destroy
/// this object after the endpoint, which removes the memory.
class SharedSegment {
 public:
  explicit SharedSegment(const rtps::GUID_t& endpoint);
  ~SharedSegment();
  SharedSegment(const SharedSegment&) = delete;
  SharedSegment& operator=(const SharedSegment&) = delete;

  /// Whether Fast DDS has created the segment and all of it is reserved.
  bool is_there() const noexcept { return is_reserved_; }

 private:
  const std::filesystem::path lock_file_;
  int lock_ = -1;
  bool is_reserved_ = false;
};

}  // namespace panvo::runtime::dds
