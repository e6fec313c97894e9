// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::stereo_places {

struct EvidenceParameters {
  double descriptor_ratio = 0.85;
  double same_object_deg = 1.0;
  double log10_false_alarms = -4.0;
  double object_share = 0.4;

  template <class Field>
  static void describe(Field&& field) {
    using P = EvidenceParameters;
    field(&P::descriptor_ratio, "descriptor_ratio", "1",
          "largest ratio of a match's descriptor distance to the second best", 0.3, 1.0);
    field(&P::same_object_deg, "same_object_deg", "deg",
          "matches closer than this in both views are one piece of evidence", 0.0, 10.0);
    field(&P::log10_false_alarms, "log10_false_alarms", "1",
          "expected number of places that a view agrees with by chance, as power of ten", -300.0, 0.0);
    field(&P::object_share, "object_share", "1",
          "width of an object that may stand elsewhere again, as part of the view; the rest must agree without it", 0.0,
          0.9);
  }
};

/// How well a view agrees with a place.
struct ViewEvidence {
  int matches = 0;                    ///< separate pieces of evidence
  int agreeing = 0;                   ///< of these, with the pose
  double log10_expected = 0.0;        ///< of the number of equally good agreements by chance
  double log10_without_object = 0.0;  ///< the largest when an object is left out
  double log10_without_plane = 0.0;   ///< when the flat surface with the most agreeing points is left out
  std::string objection;              ///< why the view does not show the place; empty if it does
};

/// A-contrario test of a pose [Moisan2004], as panvo_places does without metres: a wrong match joins things that look
/// alike, often at one height, so chance is a view's bearing at its own elevation and a random azimuth. Objects of which
/// there are several may stand elsewhere again, as may road markings and tiles. So what remains without the part of the
/// view that agrees best must pass as well, and what remains without any one flat surface. `field_of_view_rad`:
/// horizontal; `log10_places`: of the number of places that the view is compared with.
ViewEvidence judge_view(std::span<const landmarks::Keypoint> view, std::span<const landmarks::Keypoint> place,
                        const Eigen::Isometry3d& place_from_view, double field_of_view_rad, double log10_places,
                        const EvidenceParameters& parameters);

}  // namespace panvo::stereo_places
