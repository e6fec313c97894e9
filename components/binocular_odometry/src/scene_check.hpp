// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace panvo::binocular_odometry {

/// Features of one frame.
struct FeatureCounts {
  int tracked = 0;          ///< from the previous frame, in the left image
  int tracked_by_both = 0;  ///< of these, found in the right image
  int searched = 0;         ///< tracked or new ones, in the left image
  int matched = 0;          ///< of these, found in the right image
};

/// Checks whether both cameras see the same scene at the same time. They do not if most features that both had seen are
/// suddenly missing in the right image: one camera is late, covered, blurred or rotated. From then on, only those
/// features match that fit by chance, or that are so far away that they do not show the delay. Their motion is wrong,
/// so that the pair is used again only when about as many features match as before.
class SceneCheck {
 public:
  /// Returns the fault of a frame; nullopt if there is none or too few features to decide.
  std::optional<std::string> find_fault(const FeatureCounts& counts, std::int64_t stamp_ns);

 private:
  bool is_as_usual(const FeatureCounts& counts) const;

  double usual_share_ = 0.0;              // of the searched features, found in the right image
  int frames_ = 0;                        // that this is a mean of
  std::optional<std::int64_t> fault_ns_;  // stamp of the first frame that did not match, if none has since
};

}  // namespace panvo::binocular_odometry
