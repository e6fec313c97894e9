// SPDX-License-Identifier: Apache-2.0
#include "scene_check.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::binocular_odometry {
namespace {

constexpr int kMinSeen = 20;
// Recordings have at least 0.75, mostly 0.9. A half-covered camera gives 0.5; a camera that is one frame late gives
// less at 5 m/s.
constexpr double kSeenByBoth = 0.5;

// Of the usual share of matches: recordings keep above 0.8, a camera that is one frame late at 5 m/s gives about 0.5.
constexpr double kAsUsual = 0.7;
constexpr int kMemory = 50;  // frames that the usual share is a mean of: some seconds
constexpr int kKnown = 10;   // frames after which it is known
// Then the scene or a camera has changed for long: half of a lens is dirty, for instance.
constexpr std::int64_t kLongest_ns = 10'000'000'000;

}  // namespace

std::optional<std::string> SceneCheck::find_fault(const FeatureCounts& counts, std::int64_t stamp_ns) {
  const int needed = static_cast<int>(std::ceil(kSeenByBoth * counts.tracked));
  if (counts.tracked >= kMinSeen && counts.tracked_by_both < needed) {
    if (!fault_ns_) fault_ns_ = stamp_ns;
    return "left and right images do not match: of " + std::to_string(counts.tracked) +
           " features tracked in the left image, " + std::to_string(counts.tracked_by_both) +
           " were found in the right image, " + std::to_string(needed) + " needed";
  }
  if (fault_ns_ && !is_as_usual(counts)) {
    if (stamp_ns - *fault_ns_ < kLongest_ns) {
      return "left and right images do not match: of " + std::to_string(counts.searched) +
             " features in the left image, " + std::to_string(counts.matched) + " were found in the right image, " +
             std::to_string(std::lround(usual_share_ * counts.searched)) + " as a rule";
    }
    frames_ = 0;
  }
  fault_ns_.reset();
  if (counts.searched < kMinSeen) return std::nullopt;
  frames_ = std::min(frames_ + 1, kMemory);
  usual_share_ += (static_cast<double>(counts.matched) / counts.searched - usual_share_) / frames_;
  return std::nullopt;
}

bool SceneCheck::is_as_usual(const FeatureCounts& counts) const {
  return frames_ < kKnown || counts.matched >= kAsUsual * usual_share_ * counts.searched;
}

}  // namespace panvo::binocular_odometry
