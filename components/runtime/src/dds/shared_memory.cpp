// SPDX-License-Identifier: Apache-2.0
#include "shared_memory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <sstream>
#include <string>
#include <thread>

#include "participant_qos.hpp"

namespace panvo::runtime::dds {
namespace {

using std::chrono::milliseconds, std::chrono::steady_clock;

/// Making the memory of an endpoint takes milliseconds.
constexpr milliseconds kMaxWaitForTurn{1000}, kTurnCheckPeriod{1};

/// What the names of the memory of all endpoints of a participant begin with.
std::string memory_of(const rtps::GuidPrefix_t& participant) {
  std::ostringstream name;  // Fast DDS's name
  name << kSharedMemoryFolder << "/fast_datasharing_" << participant;
  return name.str();
}

std::string memory_of(const rtps::GUID_t& endpoint) {
  std::ostringstream name;
  name << memory_of(endpoint.guidPrefix) << '_' << endpoint.entityId;
  return name.str();
}

int open_lock(const std::filesystem::path& file) {
  constexpr mode_t kReadableByAll = 0444;
  const int lock = open(file.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, kReadableByAll);
  if (lock >= 0) flock(lock, LOCK_EX | LOCK_NB);
  return lock;
}

}  // namespace

SharingTurn::SharingTurn() : folder_(open(kSharedMemoryFolder, O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  const auto give_up = steady_clock::now() + kMaxWaitForTurn;
  while (folder_ >= 0 && flock(folder_, LOCK_EX | LOCK_NB) != 0 && steady_clock::now() < give_up)
    std::this_thread::sleep_for(kTurnCheckPeriod);
}

SharingTurn::~SharingTurn() {
  if (folder_ >= 0) close(folder_);
}

bool SharingTurn::has_room(std::uint64_t bytes) const {
  const int file = open(kSharedMemoryFolder, O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) return false;
  const bool has_room = posix_fallocate(file, 0, static_cast<off_t>(bytes)) == 0;
  close(file);
  return has_room;
}

bool reserve_memory_of(const rtps::GUID_t& endpoint) {
  const int file = open(memory_of(endpoint).c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  struct stat state {};
  const bool is_reserved = fstat(file, &state) == 0 && posix_fallocate(file, 0, state.st_size) == 0;
  close(file);
  return is_reserved;
}

SharingMark::SharingMark(const rtps::GuidPrefix_t& participant)
    : file_(memory_of(participant) + "_el"), lock_(open_lock(file_)) {}

SharingMark::~SharingMark() {
  if (lock_ < 0) return;
  unlink(file_.c_str());
  close(lock_);
}

}  // namespace panvo::runtime::dds
