// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/features2d.hpp>
#include <optional>
#include <vector>

#include "disparity_offset.hpp"
#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/stereo_matcher.hpp"
#include "stereo_pyramids.hpp"

namespace panvo::binocular_odometry {

/// Motion between two frames without any prediction, for frames so far apart that patches cannot be followed: SIFT
/// features of both left images are matched by descriptor, whatever their distance in the image, located in depth by the
/// right images, and the motion is found by RANSAC. Slow: two SIFT detections.
class DescriptorMotion {
 public:
  DescriptorMotion(const vision::RectifiedStereo& stereo, const MotionParameters& parameters);

  struct Found {
    Eigen::Isometry3d current_from_previous;
    std::vector<FramePair> matches;  ///< that agree with the motion
  };

  /// nullopt if too few matches agree on a motion. `offset`: known common error of the disparities.
  std::optional<Found> find(const StereoPyramids& previous, const StereoPyramids& current,
                            const vision::StereoMatcher& matcher, const DisparityOffset& offset) const;

 private:
  struct Features {
    std::vector<cv::KeyPoint> keypoints;  // of the full-size image
    cv::Mat descriptors;
  };

  Features describe(const vision::ImagePyramid& image) const;

  vision::RectifiedStereo stereo_;
  MotionParameters parameters_;
  cv::Ptr<cv::SIFT> detector_;
};

}  // namespace panvo::binocular_odometry
