// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/fleet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "panvo/vision/angle.hpp"

namespace panvo::fleet {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kAnnounce_ns = kSecond_ns;
constexpr std::int64_t kMove_ns = 2 * kSecond_ns;  // corrections come in bursts and move all places
constexpr std::int64_t kPose_ns = kSecond_ns / 2;
constexpr std::int64_t kRepeat_ns = kSecond_ns;  // between two repetitions for one robot
constexpr std::size_t kMaxRepeats = 1000;        // robots whose last repetition is remembered
constexpr std::size_t kPlacesPerMessage = 4;     // 30 kB
constexpr std::size_t kMovesPerMessage = 50;     // 17 kB
constexpr std::size_t kMaxAskedFor = 32;
constexpr std::size_t kMaxPending = 4;  // places whose keypoints were asked for and not received
constexpr std::size_t kMaxEarly = 10'000;
constexpr int kMaxViewsOfPair = 3;
constexpr double kViewStep_m = 2.0;
constexpr double kAnchorRadius_m = 60.0;
constexpr int kDecisionsPerCall = 3;  // 20 ms each with the most sightings

}  // namespace

Fleet::Fleet(const FleetParameters& parameters, std::string robot, const landmarks::KeypointParameters& keypoints,
             const landmarks::PanoramaDescriber& describer, landmarks::DescriptionSettings settings,
             std::shared_ptr<const landmarks::LandmarkSource> own_keypoints, vision::StageObserver* observer)
    : parameters_(parameters),
      robot_(std::move(robot)),
      settings_(std::move(settings)),
      settings_text_(landmarks::to_text(settings_)),
      own_keypoints_(std::move(own_keypoints)),
      members_(parameters.members, robot_, settings_, describer.basis().limits()),
      recognition_(parameters.recognition, keypoints, describer, observer),
      evidence_(parameters.join),
      budget_(1e3 * parameters.sharing.max_kb_per_s,
              1e3 * parameters.sharing.max_kb_per_s * parameters.sharing.burst_s) {}

void Fleet::add_pose(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_base, const vision::Matrix6d& covariance,
                     double speed_m_per_s) {
  trail_.add(stamp_ns, map_from_base, covariance, speed_m_per_s);
  if (!first_stamp_ns_) first_stamp_ns_ = stamp_ns;
  begin();
}

/// The own map begins when both its first place and the first pose are known.
void Fleet::begin() {
  if (own_ || !first_stamp_ns_ || early_.empty()) return;
  own_.emplace(map_id(robot_, early_.front()), session_id(robot_, *first_stamp_ns_),
               static_cast<std::size_t>(parameters_.members.max_places));
  frame_ = common_frame(own_->id(), {}, {}, parameters_.join.gate_chi_square);
  for (auto& place : std::exchange(early_, {})) own_->add(std::move(place));
  news_.push_back(fmt::format("{} shares map {}", robot_, to_text(own_->id())));
}

void Fleet::add_place(landmarks::PanoramicLandmark place) {
  move_places({{place.id, place.map_from_base, place.covariance}});
  if (own_) {
    own_->add(std::move(place));
  } else if (early_.size() < kMaxEarly) {
    early_.push_back(std::move(place));
    begin();
  }
}

void Fleet::move_places(const std::vector<landmarks::LandmarkPose>& poses) {
  for (const auto& pose : poses) {
    if (poses_.size() < kMaxEarly || poses_.contains(pose.id)) poses_[pose.id] = pose;
  }
  has_moved_ = true;
}

/// The pose relative to the own place with the smallest uncertainty between them.
std::optional<ViewPoint> Fleet::view_point(const PoseSample& pose) const {
  ViewPoint best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [id, entry] : own_->places()) {
    const auto& place = poses_.contains(id)
                            ? poses_.at(id)
                            : landmarks::LandmarkPose{id, entry.landmark.map_from_base, entry.landmark.covariance};
    const double distance_m = (place.map_from_base.translation() - pose.map_from_base.translation()).norm();
    const bool is_last = id == own_->places().rbegin()->first;
    if (distance_m > kAnchorRadius_m && !is_last) continue;
    const auto covariance = relative_covariance(place.map_from_base, place.covariance, pose.map_from_base,
                                                pose.covariance, parameters_.join);
    const double variance = covariance.topLeftCorner<3, 3>().trace();
    if (variance >= least) continue;
    least = variance;
    best.own_place = id;
    best.place_from_base = place.map_from_base.inverse() * pose.map_from_base;
    best.covariance = covariance;
  }
  best.travelled_m = pose.travelled_m;
  return best.own_place == 0 ? std::nullopt : std::optional(best);
}

std::optional<std::string> Fleet::add_panorama(std::int64_t stamp_ns, const cv::Mat& panorama,
                                               const Eigen::Isometry3d& base_from_panorama) {
  const auto pose = trail_.at(stamp_ns);
  if (!own_ || !pose) return std::nullopt;
  if (searched_at_m_ && pose->travelled_m - *searched_at_m_ < parameters_.sharing.step_m) return std::nullopt;
  auto from = view_point(*pose);
  if (!from) return std::nullopt;
  searched_at_m_ = pose->travelled_m;
  from->base_from_panorama = base_from_panorama;
  const auto fault = recognition_.add(panorama, *from, foreign_places());
  use_ready_views();
  return fault;
}

std::vector<ForeignPlace> Fleet::foreign_places() const {
  std::vector<ForeignPlace> places;
  for (const auto& [map, member] : members_.all()) {
    for (const auto& [id, place] : member.map.places()) places.push_back({{map, id}, &place.landmark});
  }
  return places;
}

void Fleet::use_ready_views() {
  const auto find = [this](const PlaceKey& key) -> const landmarks::PanoramicLandmark* {
    const auto* member = members_.find(key.map);
    return member ? member->map.find(key.place) : nullptr;
  };
  for (auto& sighting : recognition_.sightings(find)) share(std::move(sighting));
}

/// Sightings of one map are kept in a ring. Two places have at most three sightings, some path apart, each the one with
/// the most inliers: many views of one place are hardly more evidence than a few.
void Fleet::share(Sighting sighting) {
  int views = 0;
  for (const auto& [slot, seen] : own_->sightings()) {
    const auto& known = seen.sighting;
    if (known.own_place != sighting.own_place || known.seen != sighting.seen) continue;
    if (std::abs(known.travelled_m - sighting.travelled_m) < kViewStep_m) {
      if (known.inliers >= sighting.inliers) return;
      sighting.slot = slot;
      own_->add(sighting);
      return;
    }
    ++views;
  }
  if (views >= kMaxViewsOfPair) return;
  const auto count = static_cast<std::uint32_t>(sighted_.size());
  if (!sighted_.contains(sighting.seen.map)) {
    news_.push_back(fmt::format("place {} of map {} was recognised, the first one of that map: {} points agree",
                                sighting.seen.place, to_text(sighting.seen.map), sighting.inliers));
  }
  if (!sighted_.contains(sighting.seen.map) && count >= kMaxSlots / kSlotsPerMap) return;
  auto& ring = sighted_.try_emplace(sighting.seen.map, Ring{count, 0}).first->second;
  sighting.slot = ring.index * kSlotsPerMap + ring.used++ % kSlotsPerMap;
  own_->add(sighting);
}

std::optional<std::string> Fleet::hear(const Announcement& said, std::int64_t now_ns) {
  if (own_ && said.robot == robot_ && said.session == own_->session()) return std::nullopt;  // one's own
  auto refused = members_.hear(said, now_ns);
  for (const auto map : members_.take_restarted()) recognition_.forget(map);
  return refused;
}

std::optional<std::string> Fleet::take(const std::string& robot, const MapChanges& changes, std::int64_t now_ns) {
  if (robot == robot_) return std::nullopt;
  auto refused = members_.take(robot, changes, now_ns);
  for (const auto map : members_.take_restarted()) recognition_.forget(map);
  return refused;
}

std::optional<std::string> Fleet::answer(const std::string& robot, const Request& request, std::int64_t now_ns) {
  if (!own_ || robot == robot_ || request.map != own_->id()) return std::nullopt;
  if (request.from_version && *request.from_version < sent_version_) {
    const auto last = repeated_ns_.find(robot);
    if (last != repeated_ns_.end() && now_ns - last->second < kRepeat_ns) {
      return fmt::format("{} asks for repetitions more than once a second", robot);
    }
    if (last == repeated_ns_.end() && repeated_ns_.size() >= kMaxRepeats) repeated_ns_.clear();
    repeated_ns_[robot] = now_ns;
    sent_version_ = *request.from_version;
  }
  for (const auto place : request.keypoints) {
    if (!own_->find(place)) return fmt::format("{} asks for keypoints of place {}, which does not exist", robot, place);
    const bool is_queued = std::find(asked_for_.begin(), asked_for_.end(), place) != asked_for_.end();
    if (!is_queued && asked_for_.size() < kMaxAskedFor) asked_for_.push_back(place);
  }
  return std::nullopt;
}

std::optional<std::string> Fleet::take(const std::string& robot, KeypointAnswer answer) {
  if (robot == robot_) return std::nullopt;
  const auto* member = members_.find(answer.map);
  if (!member || !member->map.find(answer.place)) return std::nullopt;  // of a place not received yet
  if (member->robot != robot) return fmt::format("{} sends keypoints of a map of {}", robot, member->robot);
  recognition_.add({answer.map, answer.place}, std::move(answer.keypoints));
  if (own_) use_ready_views();
  return std::nullopt;
}

std::vector<const SharedMap*> Fleet::maps() const {
  std::vector<const SharedMap*> found;
  if (own_) found.push_back(&*own_);
  for (const auto& [map, member] : members_.all()) found.push_back(&member.map);
  return found;
}

void Fleet::advance(std::int64_t now_ns) {
  members_.advance(now_ns);
  budget_.advance(now_ns);
  if (!own_) return;
  share_moves(now_ns);
  const int changes = evidence_.made() + evidence_.undone();
  evidence_.update(maps(), kDecisionsPerCall);
  const bool has_changed = changes != evidence_.made() + evidence_.undone();
  if (posed_ns_ && now_ns - *posed_ns_ < kPose_ns && !has_changed) return;
  posed_ns_ = now_ns;
  find_frame();
  find_pose();
}

void Fleet::share_moves(std::int64_t now_ns) {
  if (!has_moved_ || (moved_ns_ && now_ns - *moved_ns_ < kMove_ns)) return;
  std::vector<landmarks::LandmarkPose> poses;
  for (const auto& [id, pose] : poses_) poses.push_back(pose);
  own_->move(poses, parameters_.sharing.moved_m, parameters_.sharing.moved_deg * vision::kDegree);
  moved_ns_ = now_ns;
  has_moved_ = false;
}

void Fleet::find_frame() {
  auto used = members_.frames_used();
  used[own_->id()] = frame_.map;
  const auto* pose = trail_.latest();
  const auto from = pose ? view_point(*pose) : std::nullopt;
  const auto near = from ? from->own_place : own_->places().rbegin()->first;
  auto frame =
      common_frame(own_->id(), evidence_.joined(maps(), own_->id(), near), used, parameters_.join.gate_chi_square);
  if (frame.map != frame_.map) news_.push_back(fmt::format("the fleet's frame is that of map {}", to_text(frame.map)));
  frame_ = std::move(frame);
}

void Fleet::find_pose() {
  const auto* pose = trail_.latest();
  if (!pose) return;
  const auto* member = members_.find(frame_.map);
  const SharedMap& common = frame_.map == own_->id() || !member ? *own_ : member->map;
  const auto found =
      most_certain_pose(common, *own_, *pose, evidence_.joined_maps(maps(), frame_.contradictory), parameters_.join);
  if (found) {
    pose_ = *found;
    common_from_own_ = pose_.common_from_base * pose->map_from_base.inverse();
  } else {
    pose_ = {};
    common_from_own_ = frame_.common_from_own.a_from_b;
  }
}

vision::Matrix6d Fleet::covariance_in_common(const vision::Matrix6d& covariance_in_own) const {
  return pose_.bridges == 0 ? covariance_in_own : pose_.covariance;
}

Announcement Fleet::announcement() const {
  const auto digest = highest_sent_ == own_->version() ? own_->digest() : 0;
  return {robot_,         own_->id(), own_->session(),
          highest_sent_,  digest,     static_cast<std::uint32_t>(own_->places().size()),
          settings_text_, frame_.map};
}

std::optional<FleetMessage> Fleet::next(std::int64_t now_ns) {
  budget_.advance(now_ns);
  if (!own_) return std::nullopt;
  // Announcements are small and always sent: without them a robot counts as absent.
  if (!announced_ns_ || now_ns - *announced_ns_ >= kAnnounce_ns) {
    announced_ns_ = now_ns;
    return announcement();
  }
  if (!budget_.is_open()) return std::nullopt;
  if (auto request = next_request(now_ns)) return *request;
  if (!asked_for_.empty()) {
    const auto place = asked_for_.front();
    asked_for_.pop_front();
    return KeypointAnswer{own_->id(), place, own_keypoints_->keypoints(place)};
  }
  if (auto changes = own_->since(sent_version_, kPlacesPerMessage, kMovesPerMessage)) {
    sent_version_ = changes->version;
    highest_sent_ = std::max(highest_sent_, sent_version_);
    return *changes;
  }
  return std::nullopt;
}

std::optional<Request> Fleet::next_request(std::int64_t now_ns) {
  if (const auto gaps = members_.gaps(now_ns, 1); !gaps.empty()) {
    return Request{gaps.front().map, gaps.front().from_version, {}};
  }
  const auto key = recognition_.next_wanted(now_ns, kMaxPending);
  if (!key) return std::nullopt;
  const auto* member = members_.find(key->map);
  if (!member || !member->is_present) return std::nullopt;  // nobody would answer
  return Request{key->map, std::nullopt, {key->place}};
}

std::vector<std::string> Fleet::take_news() {
  auto news = std::exchange(news_, {});
  for (auto& one : members_.take_news()) news.push_back(std::move(one));
  for (auto& one : evidence_.take_news()) news.push_back(std::move(one));
  return news;
}

}  // namespace panvo::fleet
