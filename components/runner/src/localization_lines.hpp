// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo_msgs/msg/AzimuthChange.h"
#include "panvo_msgs/msg/CorrectionOutcome.h"
#include "panvo_msgs/msg/Integrity.h"
#include "panvo_msgs/msg/LocalizationState.h"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "panvo_msgs/msg/PositionCorrection.h"

/// CSV lines of the localizer's inputs and outputs; nullopt if a required number is not finite.
namespace panvo::runner {

/// "stamp_ns,reliable,detected,tracked,inliers,inlier_ratio,residual_px,reason"
std::string quality_header();
std::optional<std::string> quality_line(const panvo_msgs::msg::OdometryQuality& quality);

/// "stamp_ns,from_stamp_ns,azimuth_change_rad,sigma_rad,side_parallax_rad,motion_azimuth_rad,motion_azimuth_sigma_rad,valid,reason"
std::string azimuth_header();
std::optional<std::string> azimuth_line(const panvo_msgs::msg::AzimuthChange& change);

/// "stamp_ns,landmark_id,state,inliers,x,y,z,qx,qy,qz,qw,sigma_x_m,sigma_y_m,sigma_yaw_rad,reason"; the pose: landmark_from_base
std::string correction_header();
std::optional<std::string> correction_line(const panvo_msgs::msg::PositionCorrection& correction);

/// "stamp_ns,landmark_id,outcome,chi_square,before_x,..,before_qw,after_x,..,after_qw,reason"
std::string outcome_header();
std::optional<std::string> outcome_line(const panvo_msgs::msg::CorrectionOutcome& outcome);

/// "stamp_ns,state,position_sigma_m,heading_sigma_rad,reason"
std::string state_header();
std::optional<std::string> state_line(const panvo_msgs::msg::LocalizationState& state);

/// "stamp_ns,usable,reason,risk,hpl_m,alert_limit_m"; hpl: the horizontal protection level
std::string integrity_header();
std::optional<std::string> integrity_line(const panvo_msgs::msg::Integrity& integrity);

}  // namespace panvo::runner
