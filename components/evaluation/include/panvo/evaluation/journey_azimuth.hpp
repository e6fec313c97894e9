// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/journey_revisits.hpp"

namespace panvo::evaluation {

/// A stretch in which the stereo pair saw badly, and how far each azimuth went astray in it [Lu2015 7.2, Fig. 9]. Rad, left
/// positive; nullopt where an estimate says nothing there.
struct AzimuthEpisode {
  std::string kind;  ///< "unreliable", as the odometry itself said, or that of a Disturbance
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  double travelled_m = 0.0;  ///< at its start
  double turned_rad = 0.0;   ///< by the vehicle, truly
  std::optional<double> binocular_rad, compass_rad, enhanced_rad;
  double compass_share = 0.0;  ///< of the episode in which the compass told a change
};

/// All episodes of one kind.
struct AzimuthKind {
  std::string kind;
  int episodes = 0;
  double duration_s = 0.0;
  std::optional<double> binocular_rms_rad, compass_rms_rad, enhanced_rms_rad;
  std::optional<double> binocular_worst_rad, compass_worst_rad, enhanced_worst_rad;
};

/// Azimuths through an episode and a little before and after, from 0 at its start; error: minus the true one.
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

/// The one through which the binocular azimuth went furthest astray; nullopt without episodes.
std::optional<AzimuthCurve> worst_episode(const JourneyFrames& frames, const AzimuthScore& score);

}  // namespace panvo::evaluation
