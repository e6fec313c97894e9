// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "geometry_msgs/msg/PoseWithCovarianceStamped.h"
#include "geometry_msgs/msg/TwistWithCovarianceStamped.h"
#include "nav_msgs/msg/Odometry.h"
#include "nav_msgs/msg/Path.h"
#include "panvo/interfaces/topic.hpp"
#include "panvo_msgs/msg/AzimuthChange.h"
#include "panvo_msgs/msg/CorrectionOutcome.h"
#include "panvo_msgs/msg/Integrity.h"
#include "panvo_msgs/msg/LandmarkMatch.h"
#include "panvo_msgs/msg/LandmarkPoses.h"
#include "panvo_msgs/msg/LocalizationState.h"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "panvo_msgs/msg/PanoramaPoints.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"
#include "panvo_msgs/msg/PositionCorrection.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"
#include "sensor_msgs/msg/Imu.h"
#include "sensor_msgs/msg/PointCloud2.h"
#include "tf2_msgs/msg/TFMessage.h"

/// The topics of panvo's components. Components use these constants instead of names of their own.
namespace panvo::topics {

using interfaces::Topic;
namespace qos = interfaces::qos;

inline constexpr Topic<sensor_msgs::msg::Image> kStereoLeftImageRaw{"stereo/left/image_raw", qos::kSensorData};
inline constexpr Topic<sensor_msgs::msg::Image> kStereoRightImageRaw{"stereo/right/image_raw", qos::kSensorData};
inline constexpr Topic<sensor_msgs::msg::Image> kStereoLeftImageRect{"stereo/left/image_rect", qos::kSensorData};
inline constexpr Topic<sensor_msgs::msg::Image> kStereoRightImageRect{"stereo/right/image_rect", qos::kSensorData};
inline constexpr Topic<sensor_msgs::msg::CameraInfo> kStereoLeftCameraInfo{"stereo/left/camera_info", qos::kSensorData};
inline constexpr Topic<sensor_msgs::msg::CameraInfo> kStereoRightCameraInfo{"stereo/right/camera_info",
                                                                            qos::kSensorData};
inline constexpr Topic<sensor_msgs::msg::Image> kPanorama{"panorama/image", qos::kSensorData};
/// Where the panorama shows the vehicle itself: mono8, few pixels for the whole panorama; 0: the vehicle.
inline constexpr Topic<sensor_msgs::msg::Image> kVehicleMask{"panorama/vehicle_mask", qos::kLatched};
/// Raw images of the heads of a panoramic camera; the stitcher makes the panorama from them.
inline constexpr std::array<Topic<sensor_msgs::msg::Image>, 6> kPanoramaHeadImageRaw{
    {{"panorama/head_0/image_raw", qos::kSensorData},
     {"panorama/head_1/image_raw", qos::kSensorData},
     {"panorama/head_2/image_raw", qos::kSensorData},
     {"panorama/head_3/image_raw", qos::kSensorData},
     {"panorama/head_4/image_raw", qos::kSensorData},
     {"panorama/head_5/image_raw", qos::kSensorData}}};
inline constexpr std::array<Topic<sensor_msgs::msg::CameraInfo>, 6> kPanoramaHeadCameraInfo{
    {{"panorama/head_0/camera_info", qos::kSensorData},
     {"panorama/head_1/camera_info", qos::kSensorData},
     {"panorama/head_2/camera_info", qos::kSensorData},
     {"panorama/head_3/camera_info", qos::kSensorData},
     {"panorama/head_4/camera_info", qos::kSensorData},
     {"panorama/head_5/camera_info", qos::kSensorData}}};

/// Sensors of motion, all optional: a tenth of a second at up to 1 kHz. Of wheel/odometry only the velocity is used.
inline constexpr interfaces::Qos kMotionSensor{.requested = interfaces::Reliability::kBestEffort, .depth = 100};
inline constexpr Topic<nav_msgs::msg::Odometry> kWheelOdometry{"wheel/odometry", kMotionSensor};
inline constexpr Topic<geometry_msgs::msg::TwistWithCovarianceStamped> kWheelTwist{"wheel/twist", kMotionSensor};
inline constexpr Topic<sensor_msgs::msg::Imu> kImu{"imu/data", kMotionSensor};

inline constexpr Topic<nav_msgs::msg::Odometry> kOdometryBinocular{"odometry/binocular", qos::kResult};
inline constexpr Topic<panvo_msgs::msg::OdometryQuality> kOdometryQuality{"odometry/quality", qos::kResult};
/// Points that the odometry tracks: x, y, z in the odometry's frame, u, v in the left image. Only made for readers.
inline constexpr Topic<sensor_msgs::msg::PointCloud2> kOdometryPoints{"odometry/points", qos::kSensorData};
/// Stereo odometry, continued by the panoramas while the stereo camera fails.
inline constexpr Topic<nav_msgs::msg::Odometry> kOdometryAllRound{"odometry/all_round", qos::kResult};
inline constexpr Topic<panvo_msgs::msg::OdometryQuality> kOdometryAllRoundQuality{"odometry/all_round_quality",
                                                                                  qos::kResult};
/// Stereo odometry, gyroscope and wheels in one.
inline constexpr Topic<nav_msgs::msg::Odometry> kOdometryFused{"odometry/fused", qos::kResult};
inline constexpr Topic<panvo_msgs::msg::OdometryQuality> kOdometryFusedQuality{"odometry/fused_quality", qos::kResult};
inline constexpr Topic<nav_msgs::msg::Odometry> kOdometryEnhanced{"odometry/enhanced", qos::kResult};
/// The enhanced pose, carried on to each sample of the gyroscope.
inline constexpr Topic<nav_msgs::msg::Odometry> kOdometryFast{"odometry/fast", kMotionSensor};
inline constexpr Topic<panvo_msgs::msg::AzimuthChange> kAzimuthChange{"compass/azimuth_change", qos::kResult};
/// Points on all sides that the compass tracks. Only made for readers.
inline constexpr Topic<panvo_msgs::msg::PanoramaPoints> kPanoramaPoints{"compass/points", qos::kResult};
/// Each landmark once, when it is built.
inline constexpr Topic<panvo_msgs::msg::PanoramicLandmark> kLandmarks{"landmarks", qos::kHistory};
inline constexpr Topic<panvo_msgs::msg::LandmarkMatch> kLandmarkMatch{"landmarks/match", qos::kResult};
/// Current poses of all landmarks.
inline constexpr Topic<panvo_msgs::msg::LandmarkPoses> kLandmarkPoses{"landmarks/poses", qos::kLatched};
inline constexpr Topic<panvo_msgs::msg::PositionCorrection> kCorrection{"correction", qos::kResult};
inline constexpr Topic<panvo_msgs::msg::CorrectionOutcome> kCorrectionOutcome{"correction/outcome", qos::kResult};
inline constexpr Topic<panvo_msgs::msg::LocalizationState> kLocalizationState{"localization/state", qos::kState};
/// Protection level of the published pose at a stated risk, and whether the pose may be used.
inline constexpr Topic<panvo_msgs::msg::Integrity> kIntegrity{"localization/integrity", qos::kState};
/// A pose given by an operator: RViz's "2D Pose Estimate".
inline constexpr Topic<geometry_msgs::msg::PoseWithCovarianceStamped> kInitialPose{"/initialpose", qos::kDefault};
inline constexpr Topic<nav_msgs::msg::Path> kPathBinocular{"path/binocular", qos::kResult};
inline constexpr Topic<nav_msgs::msg::Path> kPathEnhanced{"path/enhanced", qos::kResult};
inline constexpr Topic<nav_msgs::msg::Odometry> kGroundTruth{"ground_truth/odometry", qos::kResult};

inline constexpr Topic<tf2_msgs::msg::TFMessage> kTf{"/tf", {.depth = 100}};
inline constexpr Topic<tf2_msgs::msg::TFMessage> kTfStatic{"/tf_static", qos::kLatched};

}  // namespace panvo::topics
