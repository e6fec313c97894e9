// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

/// A turn in making shared memory: one process of this machine at a time checks that /dev/shm has room and takes it.
/// Fast DDS creates the memory of an endpoint without pages; if another process takes the room in between, writing to it
/// ends the process (SIGBUS). Hold this object from before the endpoint is created until reserve_memory_of() returns.
class SharingTurn {
 public:
  /// Waits for other processes, but not long: if one of them stands still, the turn is taken anyway.
  SharingTurn();
  ~SharingTurn();
  SharingTurn(const SharingTurn&) = delete;
  SharingTurn& operator=(const SharingTurn&) = delete;

  /// Whether /dev/shm has room for `bytes`.
  bool has_room(std::uint64_t bytes) const;

 private:
  const int folder_;
};

/// Reserves all pages of the memory that Fast DDS has created for an endpoint, `/dev/shm/fast_datasharing_ID`. False:
/// there is none, or not enough room; it must not be written to.
bool reserve_memory_of(const rtps::GUID_t& endpoint);

/// Marks the shared memory of a participant as in use for the lifetime of this object. If a process is killed, Fast DDS
/// 2.9 leaves the memory behind without a sign that the owner is gone. The mark is a lock on the file
/// `/dev/shm/fast_datasharing_PARTICIPANT_el`, which remove_shm_leftovers() checks. Create it before the memory, so that
/// no memory is ever without a mark, and destroy it after.
class SharingMark {
 public:
  explicit SharingMark(const rtps::GuidPrefix_t& participant);
  ~SharingMark();
  SharingMark(const SharingMark&) = delete;
  SharingMark& operator=(const SharingMark&) = delete;

 private:
  const std::filesystem::path file_;
  const int lock_;
};

}  // namespace panvo::runtime::dds
