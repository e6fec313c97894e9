// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/fleet/fleet.hpp"
#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::fleet {

/// The algorithm's parameters, the frames, and the settings of the component.
struct ComponentParameters {
  std::string robot;
  SharingParameters sharing;
  MemberParameters members;
  RecognitionParameters recognition;
  JoinParameters join;
  landmarks::DescriptionParameters description;
  landmarks::KeypointParameters keypoints;
  int description_seed = 1;
  std::string base_frame = "base_link";
  std::string map_frame = "map";
  std::string fleet_frame = "fleet";
  std::string spill_folder = "/var/tmp";

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field(&P::robot, "robot", "", "name of this robot, unique in the fleet; required");
    field.group(&P::sharing, "sharing");
    field.group(&P::members, "members");
    field.group(&P::recognition, "recognition");
    field.group(&P::join, "join");
    field.group(&P::description, "description");
    field.group(&P::keypoints, "keypoints");
    field(&P::description_seed, "description_seed", "",
          "seed of the measurement matrices; must be equal in all nodes and robots that describe panoramas", 0,
          1'000'000'000);
    field(&P::base_frame, "base_frame", "", "vehicle frame; /tf_static gives the extrinsics of the panoramic camera");
    field(&P::map_frame, "map_frame", "", "frame of the own map");
    field(&P::fleet_frame, "fleet_frame", "", "frame that all joined robots share");
    field.path(&P::spill_folder, "spill_folder",
               "folder on a disk for an unnamed file of the own keypoints, 40 kB per place; empty: keep in memory");
  }
};

}  // namespace panvo::fleet
