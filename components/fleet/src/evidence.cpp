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

}  // namespace

void Evidence::update(const std::vector<const SharedMap*>& maps, int most) {
  std::map<Pair, Decision> kept;
  int count = 0;
  for (const auto* one : maps) {
    for (const auto* other : maps) {
      if (one->id() >= other->id()) continue;
      const Pair pair{one->id(), other->id()};
      const std::pair versions{one->version(), other->version()}, sessions{one->session(), other->session()};
      const auto known = decisions_.find(pair);
      const bool is_current =
          known != decisions_.end() && known->second.versions == versions && known->second.sessions == sessions;
      if (is_current || (count >= most && known != decisions_.end())) {
        kept.emplace(pair, std::move(known->second));
        continue;
      }
      if (count++ >= most) continue;
      auto& decision = kept[pair] = {versions, sessions, decide(*one, *other, parameters_)};
      report(pair, known == decisions_.end() ? MapJoin{} : known->second.join, decision.join);
    }
  }
  decisions_ = std::move(kept);
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
    news_.push_back(
        fmt::format("maps {} and {} are no longer joined: {}", to_text(pair.first), to_text(pair.second), now.reason));
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
    const auto is_pair = [&pair](const auto& other) {
      return std::minmax(other.first, other.second) == std::minmax(pair.first, pair.second);
    };
    if (!decision.join.is_joined || std::any_of(left_out.begin(), left_out.end(), is_pair)) continue;
    found.push_back({by_id.at(pair.first), by_id.at(pair.second), decision.join.agreed});
  }
  return found;
}

std::vector<std::string> Evidence::take_news() { return std::exchange(news_, {}); }

}  // namespace panvo::fleet
