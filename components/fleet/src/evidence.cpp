// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace panvo::fleet {
namespace {

CrossSighting swapped(const CrossSighting& sighting) {
  return {sighting.place_b,
          sighting.place_a,
          sighting.a_from_b.inverse(),
          vision::invert_covariance(sighting.a_from_b, sighting.covariance),
          sighting.travelled_m,
          !sighting.by_a};
}

std::array<std::uint64_t, 4> versions_of(const SharedMap& one, const SharedMap& other) {
  return {one.session(), one.version(), other.session(), other.version()};
}

}  // namespace

void Evidence::update(const std::vector<const SharedMap*>& maps, int most) {
  struct Stale {
    std::uint64_t decided;
    const SharedMap *one, *other;
  };
  std::vector<Stale> stale;
  std::map<Pair, Decision> kept;
  for (const auto* one : maps) {
    for (const auto* other : maps) {
      if (one->id() >= other->id()) continue;
      const Pair pair{one->id(), other->id()};
      const auto known = decisions_.find(pair);
      const bool is_known = known != decisions_.end();
      if (!is_known || known->second.versions != versions_of(*one, *other)) {
        stale.push_back({is_known ? known->second.decided : 0, one, other});
      }
      if (is_known) kept.emplace(pair, std::move(known->second));
    }
  }
  decisions_ = std::move(kept);
  // Those decided longest ago first, so that a map that changes all the time does not keep the others waiting.
  std::stable_sort(stale.begin(), stale.end(),
                   [](const Stale& one, const Stale& other) { return one.decided < other.decided; });
  stale.resize(std::min(stale.size(), static_cast<std::size_t>(most)));
  for (const auto& [decided, one, other] : stale) {
    const Pair pair{one->id(), other->id()};
    auto& decision = decisions_[pair];
    auto join = decide(*one, *other, parameters_);
    report(pair, decision.join, join);
    decision = {versions_of(*one, *other), ++count_, std::move(join)};
  }
}

void Evidence::report(const Pair& pair, const MapJoin& before, const MapJoin& now) {
  if (before.is_joined == now.is_joined) return;
  if (now.is_joined) {
    ++made_;
    news_.push_back(fmt::format("maps {} and {} are joined: {} of {} sightings agree, {} contradict",
                                to_text(pair.first), to_text(pair.second), now.agreeing, now.sightings,
                                now.contradicting));
  } else {
    ++undone_;
    news_.push_back(fmt::format("the join of maps {} and {} was undone: {}", to_text(pair.first), to_text(pair.second),
                                now.reason));
  }
}

const MapJoin* Evidence::find(MapId one, MapId other) const {
  const auto found = decisions_.find({std::min(one, other), std::max(one, other)});
  return found == decisions_.end() ? nullptr : &found->second.join;
}

std::vector<JoinedPair> Evidence::joined(const std::vector<const SharedMap*>& maps, MapId own,
                                         std::uint32_t near) const {
  std::map<MapId, const SharedMap*> by_id;
  for (const auto* map : maps) by_id[map->id()] = map;
  std::vector<JoinedPair> pairs;
  for (const auto& [pair, decision] : decisions_) {
    if (!decision.join.is_joined) continue;
    auto [a, b] = pair;
    auto agreed = decision.join.agreed;
    if (b == own) {
      std::swap(a, b);
      std::transform(agreed.begin(), agreed.end(), agreed.begin(), swapped);
    }
    const auto place = a == own ? near : agreed.back().place_a;
    if (const auto transform = fit(*by_id.at(a), *by_id.at(b), agreed, place, parameters_)) {
      pairs.push_back({a, b, *transform, decision.join.agreeing});
    }
  }
  return pairs;
}

std::vector<JoinedMaps> Evidence::joined_maps(const std::vector<const SharedMap*>& maps,
                                              const std::vector<std::pair<MapId, MapId>>& left_out) const {
  std::map<MapId, const SharedMap*> by_id;
  for (const auto* map : maps) by_id[map->id()] = map;
  std::vector<JoinedMaps> found;
  for (const auto& [pair, decision] : decisions_) {
    const auto is_pair = [&joined = pair](const auto& other) {
      return std::minmax(other.first, other.second) == std::minmax(joined.first, joined.second);
    };
    if (!decision.join.is_joined || std::any_of(left_out.begin(), left_out.end(), is_pair)) continue;
    found.push_back({by_id.at(pair.first), by_id.at(pair.second), decision.join.agreed});
  }
  return found;
}

std::vector<std::string> Evidence::take_news() { return std::exchange(news_, {}); }

}  // namespace panvo::fleet
