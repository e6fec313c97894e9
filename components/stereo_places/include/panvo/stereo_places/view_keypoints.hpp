// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/epipolar_misalignment.hpp"
#include "panvo/vision/stereo_matcher.hpp"

namespace panvo::stereo_places {

struct ViewKeypointParameters {
  int most = 300;
  int pixels = 100'000;
  double min_contrast = 0.02;
  bool upright = true;

  template <class Field>
  static void describe(Field&& field) {
    using P = ViewKeypointParameters;
    field(&P::most, "most", "1", "SIFT features kept per view", 50, 5000);
    field(&P::pixels, "pixels", "1",
          "largest number of pixels that is searched; larger images are reduced by a whole number. The time is "
          "proportional to it",
          10'000, 100'000'000);
    field(&P::min_contrast, "min_contrast", "1", "smallest contrast of a SIFT feature", 0.001, 0.2);
    field(&P::upright, "upright", "",
          "descriptors keep the image's vertical: more distinctive, for cameras that roll by less than 15 degrees");
  }
};

/// Factor by which an image of the camera is reduced before the search, 1 or more.
int reduction(const vision::PinholeCamera& camera, const ViewKeypointParameters& parameters);

/// SIFT features of the left rectified image (CV_8UC1, of the camera's size), strongest first, spread over the columns.
/// Bearings are in the left rectified optical frame. Throws std::invalid_argument for an image of another size or type.
std::vector<landmarks::Keypoint> detect_view_keypoints(const cv::Mat& left, const vision::PinholeCamera& camera,
                                                       const ViewKeypointParameters& parameters);

/// Measures keypoints by their disparities. Learns by how much the rows of the right image are off, as the odometry does.
class ViewDepths {
 public:
  explicit ViewDepths(const vision::RectifiedStereo& stereo);

  /// Gives keypoints points in metres, and removes those that have none: without a match in the right image, or so far
  /// away that the disparity is noise. `offset_px`: by how much disparities are too large, and its standard deviation.
  void keep_measured(std::vector<landmarks::Keypoint>& keypoints, const cv::Mat& left, const cv::Mat& right,
                     double offset_px = 0.0, double offset_sigma_px = 0.0);

 private:
  vision::RectifiedStereo stereo_;
  vision::StereoMatcher matcher_;
  vision::EpipolarCalibration alignment_;
};

}  // namespace panvo::stereo_places
