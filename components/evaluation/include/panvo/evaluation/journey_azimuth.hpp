// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/journey_revisits.hpp"

namespace panvo::evaluation {

/// A segment with degraded stereo vision and the azimuth error of each source in it [Lu2015 7.2, Fig. 9]. Errors in
/// rad, left positive; nullopt if a source has no data there.
struct AzimuthEpisode {
  std::string kind;  ///< "unreliable" (reported by the odometry) or the kind of a Disturbance
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  double travelled_m = 0.0;  ///< at its start
  double turned_rad = 0.0;   ///< true turn of the vehicle
  std::optional<double> binocular_rad, compass_rad, enhanced_rad;
  double compass_share = 0.0;  ///< fraction of the episode in which the compass reported a change
};

/// All episodes of one kind.
struct AzimuthKind {
  std::string kind;
  int episodes = 0;
  double duration_s = 0.0;
  std::optional<double> binocular_rms_rad, compass_rms_rad, enhanced_rms_rad;
  std::optional<double> binocular_worst_rad, compass_worst_rad, enhanced_worst_rad;
};

/// Azimuths during an episode and shortly before and after, 0 at its start. The error is the azimuth minus the true
/// one.
struct AzimuthCurve {
  struct Point {
    double time_s = 0.0;
    double azimuth_rad = 0.0;
    double error_rad = 0.0;
  };
  AzimuthEpisode episode;
  std::vector<Point> truth, binocular, compass, enhanced;
};

struct AzimuthScore {
  std::vector<AzimuthEpisode> episodes;  ///< in order of kind and time
  std::vector<AzimuthKind> kinds;
};

AzimuthScore score_azimuth(const JourneyFrames& frames);

/// The episode with the largest binocular azimuth error; nullopt without episodes.
std::optional<AzimuthCurve> worst_episode(const JourneyFrames& frames, const AzimuthScore& score);

}  // namespace panvo::evaluation
