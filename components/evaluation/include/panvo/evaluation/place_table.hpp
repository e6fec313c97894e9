// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/evaluation/place_method.hpp"
#include "panvo/evaluation/place_recording.hpp"

namespace panvo::evaluation {

/// A place of the library: the panorama of its first visit.
struct KnownPlace {
  int place = 0;
  std::size_t panorama = 0;  ///< index in the recording of the first visit
};

/// A later visit of a known place.
struct PlaceRevisit {
  std::size_t known = 0;      ///< index of the known place
  std::size_t panorama = 0;   ///< index in the recording of this visit
  double entrance_rad = 0.0;  ///< yaw at this panorama minus yaw at the known one, left positive
  double offset_m = 0.0;      ///< distance between the two
};

struct PlaceTask {
  std::vector<KnownPlace> places;
  std::vector<PlaceRevisit> revisits;
};

/// The places are the first visits in `first`. The revisits are later visits in `first` or, with `then`, all visits in
/// `then` to these places. Each revisit uses the panorama nearest to the known one.
PlaceTask place_task(const PlaceRecording& first, const PlaceRecording* then = nullptr);

/// Result of comparing one panorama with the library.
struct PlaceSample {
  std::size_t revisit = 0;  ///< index of the revisit; for negatives, of the known place compared with all others
  std::size_t best = 0;     ///< index of the known place with the smallest distance
  double distance = 0.0;    ///< D' [Lu2015 Eq. 14], 0 to 1 over all samples of the method
  double heading_error_rad = 0.0;
  bool is_right = false;
};

/// A line of Table 1 [Lu2015 7.1]. Negatives are the known places, each compared with all others; positives are the
/// revisits.
struct PlaceScore {
  std::string method;
  double separation = 0.0;  ///< V_sc = mean of negatives - mean of positives [Lu2015 Eqs. 13, 14]
  int true_positives = 0;   ///< revisits whose most similar place is the right one
  int false_positives = 0;  ///< negatives accepted by a threshold that keeps all true positives
  int revisits = 0;
  double recall = 0.0, precision = 0.0;
  double recall_at_full_precision = 0.0;  ///< by a threshold that accepts no wrong place
  double median_heading_error_rad = 0.0;  ///< of the true positives
  std::vector<PlaceSample> positives, negatives;
};

PlaceScore score_places(const PlaceMethod& method, const PlaceTask& task, const PlaceRecording& first,
                        const PlaceRecording& then);

/// Table 1 as text.
std::string place_table(const std::vector<PlaceScore>& scores);

}  // namespace panvo::evaluation
