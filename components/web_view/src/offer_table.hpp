// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace panvo::web_view {

/// A topic or service with the id by which clients name it.
template <class Description>
struct Offer {
  std::uint32_t id;
  Description what;
};

/// What is offered to clients: runtime::TopicDescription or runtime::ServiceDescription. Ids are never reused, because
/// clients cache types by id. Not thread-safe.
template <class Description>
class OfferTable {
 public:
  static constexpr std::size_t kMax = 10'000;

  struct Change {
    std::vector<Offer<Description>> added;
    std::vector<std::uint32_t> removed;
  };

  /// Adds the new and removes those that are gone. One of another type is another one.
  Change update(const std::vector<Description>& present) {
    Change change;
    std::set<Key> keys;
    for (const auto& one : present) keys.insert(key_of(one));
    std::erase_if(ids_, [&](const auto& entry) {
      if (keys.contains(entry.first)) return false;
      change.removed.push_back(entry.second);
      offers_.erase(entry.second);
      return true;
    });
    left_out_ = 0;
    for (const auto& one : present) {
      if (ids_.contains(key_of(one))) continue;
      if (ids_.size() >= kMax) {
        ++left_out_;
        continue;
      }
      const std::uint32_t id = next_id_++;
      ids_.emplace(key_of(one), id);
      offers_.emplace(id, one);
      change.added.push_back({id, one});
    }
    return change;
  }

  std::vector<Offer<Description>> all() const {
    std::vector<Offer<Description>> all;
    for (const auto& [id, what] : offers_) all.push_back({id, what});
    return all;
  }

  /// nullptr: unknown id.
  const Description* find(std::uint32_t id) const {
    const auto found = offers_.find(id);
    return found == offers_.end() ? nullptr : &found->second;
  }

  /// Those beyond kMax at the last update().
  std::size_t left_out() const { return left_out_; }

 private:
  using Key = std::pair<std::string, std::string>;  // name, type
  static Key key_of(const Description& one) { return {one.name, one.type_name}; }

  std::map<Key, std::uint32_t> ids_;
  std::map<std::uint32_t, Description> offers_;
  std::uint32_t next_id_ = 1;
  std::size_t left_out_ = 0;
};

}  // namespace panvo::web_view
