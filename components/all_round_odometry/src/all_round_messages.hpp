// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "nav_msgs/msg/Odometry.h"
#include "panvo/all_round_odometry/all_round_odometry.hpp"
#include "panvo/conversions/odometry_join.hpp"
#include "panvo/conversions/result.hpp"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "panvo_msgs/msg/PanoramaPoints.h"

/// Conversions between messages and the algorithm's types.
namespace panvo::all_round_odometry {

/// The reason names a rotation that is none.
conversions::Result<PanoramaPoints> to_points(const panvo_msgs::msg::PanoramaPoints& message);

/// `like`: gives the frames, and the twist of a stereo pose. `twist`: that of a pose by panoramas, in the vehicle's axes.
nav_msgs::msg::Odometry to_odometry(const AllRoundPose& pose, const nav_msgs::msg::Odometry& like,
                                    const vision::Vector6d& twist);

panvo_msgs::msg::OdometryQuality to_quality(const AllRoundPose& pose,
                                            const conversions::OdometryJoin::Quality& of_stereo,
                                            const std::string& base_frame);

}  // namespace panvo::all_round_odometry
