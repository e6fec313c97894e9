// SPDX-License-Identifier: Apache-2.0
#include "shared_segment.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sstream>

#include "fast_dds.hpp"
#include "participant_qos.hpp"

namespace panvo::runtime::dds {
namespace {

std::string segment_name(const rtps::GUID_t& endpoint) {
  std::ostringstream name;  // Fast DDS's name
  name << kSharedMemoryFolder << "/fast_datasharing_" << endpoint.guidPrefix << "_" << endpoint.entityId;
  return name.str();
}

/// Reserves pages for the whole file, which Fast DDS creates without pages. False: not enough memory.
bool reserve(const std::string& segment) {
  const int file = open(segment.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  struct stat state {};
  const bool is_reserved = fstat(file, &state) == 0 && posix_fallocate(file, 0, state.st_size) == 0;
  close(file);
  return is_reserved;
}

}  // namespace

bool has_room_to_share(std::uint64_t bytes) {
  const int file = open(kSharedMemoryFolder, O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) return false;
  const bool has_room = posix_fallocate(file, 0, static_cast<off_t>(bytes)) == 0;
  close(file);
  return has_room;
}

SharedSegment::SharedSegment(const rtps::GUID_t& endpoint) : lock_file_(segment_name(endpoint) + "_el") {
  is_reserved_ = reserve(segment_name(endpoint));
  if (!is_reserved_) return;
  constexpr mode_t kReadableByAll = 0444;
  lock_ = open(lock_file_.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, kReadableByAll);
  if (lock_ >= 0) flock(lock_, LOCK_EX | LOCK_NB);
}

SharedSegment::~SharedSegment() {
  if (lock_ < 0) return;
  unlink(lock_file_.c_str());
  close(lock_);
}

}  // namespace panvo::runtime::dds
