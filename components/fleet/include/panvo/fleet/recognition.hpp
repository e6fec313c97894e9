// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "panvo/fleet/shared_map.hpp"
#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/position_corrector/panorama_pose.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::fleet {

struct RecognitionParameters {
  int max_compared = 2000;
  double max_histogram_distance = 0.6;
  double max_large_distance = 0.8;
  double max_small_distance = 0.85;
  int max_verified = 3;
  int max_keypoint_sets = 100;
  double retry_s = 2.0;
  int max_tries = 5;
  position_corrector::PanoramaPoseParameters pose;

  template <class Field>
  static void describe(Field&& field) {
    using P = RecognitionParameters;
    field(&P::max_compared, "max_compared", "1",
          "places of other robots compared with a panorama; of more, each panorama is compared with the next ones", 1,
          100'000);
    field(&P::max_histogram_distance, "max_histogram_distance", "1", "T_h [Lu2015 5.1]", 0.0, 1.0);
    field(
        &P::max_large_distance, "max_large_distance", "1",
        "T_fl; other places have 0.9 +- 0.05. Below that of the position corrector, as no position narrows the search "
        "and each candidate may cost a transmission",
        0.0, 1.0);
    field(&P::max_small_distance, "max_small_distance", "1", "T_fs, likewise", 0.0, 1.0);
    field(&P::max_verified, "max_verified", "1", "candidates per panorama whose geometry is verified", 1, 20);
    field(&P::max_keypoint_sets, "max_keypoint_sets", "1", "places whose keypoints are kept, 45 kB each", 1, 10'000);
    field(&P::retry_s, "retry_s", "s", "time after which missing keypoints are asked for again", 0.1, 60.0);
    field(&P::max_tries, "max_tries", "1", "requests for the keypoints of a place before it is given up", 1, 100);
    field.group(&P::pose, "pose");
  }
};

/// Where a panorama was taken: relative to a place of the own map, so that the sighting moves with the map.
struct ViewPoint {
  std::uint32_t own_place = 0;
  Eigen::Isometry3d place_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Identity();
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  double travelled_m = 0.0;
};

/// A place of another map to compare with.
struct ForeignPlace {
  PlaceKey key;
  const landmarks::PanoramicLandmark* landmark = nullptr;
};

/// Recognises places of other robots in panoramas, without a position. The levels are those of the position corrector
/// [Lu2015 5.1]; the keypoints of the few candidates that pass them have to be asked for, and their panoramas wait for
/// them. The work per panorama is bounded.
class Recognition {
 public:
  Recognition(const RecognitionParameters& parameters, const landmarks::KeypointParameters& keypoints,
              const landmarks::PanoramaDescriber& describer, vision::StageObserver* observer = nullptr);

  /// Compares a panorama (CV_8UC1, 2:1) with `places`, in order of keys. Its sightings follow from sightings(). The
  /// reason if the panorama cannot be described.
  std::optional<std::string> add(const cv::Mat& panorama, const ViewPoint& from,
                                 const std::vector<ForeignPlace>& places);

  /// Keypoints that were asked for, or that another robot asked for: kept if there is room.
  void add(const PlaceKey& key, std::vector<landmarks::Keypoint> keypoints);
  /// The keypoints of a map are void.
  void forget(MapId map);

  /// Verifies what can be verified. `find(PlaceKey)` returns the current landmark or nullptr.
  template <class Find>
  std::vector<Sighting> sightings(Find find) {
    std::vector<Sighting> found;
    for (const auto& ready : take_ready()) {
      const landmarks::PanoramicLandmark* landmark = find(ready.key);
      if (!landmark) continue;
      if (auto sighting = verify(ready, *landmark)) found.push_back(*sighting);
    }
    return found;
  }

  /// The most similar place whose keypoints should be asked for now; nullopt if there is none, or if `max_pending` were
  /// asked for and may still come.
  std::optional<PlaceKey> next_wanted(std::int64_t now_ns, std::size_t max_pending);

  struct Counts {
    std::uint64_t panoramas = 0, compared = 0, candidates = 0, verified = 0, recognised = 0, given_up = 0;
  };
  const Counts& counts() const noexcept { return counts_; }

 private:
  struct Candidate {
    PlaceKey key;
    double heading_rad = 0.0;
    float large = 1.0F, small = 1.0F;
  };
  struct View {
    std::vector<landmarks::Keypoint> keypoints;
    ViewPoint from;
    std::vector<Candidate> candidates;  ///< not verified yet
  };
  struct Ready {
    PlaceKey key;
    double heading_rad = 0.0;
    std::vector<landmarks::Keypoint> keypoints;
    ViewPoint from;
  };
  struct Wanted {
    float distance = 1.0F;
    std::optional<std::int64_t> asked_ns;
    int tries = 0;
  };
  struct Kept {
    std::vector<landmarks::Keypoint> keypoints;
    std::uint64_t used = 0;
  };

  std::vector<Candidate> search(const landmarks::QueryDescription& query, const std::vector<ForeignPlace>& places);
  std::vector<Ready> take_ready();
  std::optional<Sighting> verify(const Ready& ready, const landmarks::PanoramicLandmark& landmark);
  void drop_unwanted();

  const RecognitionParameters parameters_;
  const landmarks::KeypointParameters keypoint_parameters_;
  const landmarks::PanoramaDescriber& describer_;
  vision::StageObserver* observer_;
  std::deque<View> views_;
  std::map<PlaceKey, Wanted> wanted_;
  std::map<PlaceKey, Kept> kept_;
  std::uint64_t uses_ = 0;
  std::size_t next_ = 0;  ///< place to begin with, if there are too many
  Counts counts_;
};

}  // namespace panvo::fleet
