// SPDX-License-Identifier: Apache-2.0
#include "own_participants.hpp"

#include <mutex>
#include <set>
#include <shared_mutex>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {
namespace {

struct OwnParticipants {
  std::shared_mutex mutex;
  std::set<rtps::GuidPrefix_t> prefixes;
};

OwnParticipants& own_participants() {
  static OwnParticipants own;
  return own;
}

}  // namespace

void add_own_participant(const rtps::GUID_t& participant) {
  auto& own = own_participants();
  const std::lock_guard lock(own.mutex);
  own.prefixes.insert(participant.guidPrefix);
}

bool is_of_this_process(const rtps::GUID_t& endpoint) {
  auto& own = own_participants();
  const std::shared_lock lock(own.mutex);
  return own.prefixes.contains(endpoint.guidPrefix);
}

}  // namespace panvo::runtime::dds
