// SPDX-License-Identifier: Apache-2.0
#include "shared_segment.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <sstream>
#include <system_error>

#include "participant_qos.hpp"

namespace panvo::runtime::dds {
namespace {

std::string segment_name(const eprosima::fastrtps::rtps::GUID_t& endpoint) {
  std::ostringstream name;  // as Fast DDS calls it
  name << kSharedMemoryFolder << "/fast_datasharing_" << endpoint.guidPrefix << "_" << endpoint.entityId;
  return name.str();
}

}  // namespace

SharedSegment::SharedSegment(const eprosima::fastrtps::rtps::GUID_t& endpoint)
    : lock_file_(segment_name(endpoint) + "_el") {
  std::error_code error;
  if (!std::filesystem::exists(segment_name(endpoint), error)) return;
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
