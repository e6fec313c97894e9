// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::stereo_places {

struct ViewKeypointParameters {
  int most = 300;
  int columns = 640;
  double min_contrast = 0.02;
  bool upright = true;

  template <class Field>
  static void describe(Field&& field) {
    using P = ViewKeypointParameters;
    field(&P::most, "most", "1", "SIFT features kept per view", 50, 5000);
    field(&P::columns, "columns", "px",
          "largest width of the image that is searched; wider ones are reduced by a whole number: a quarter of the time "
          "per half",
          160, 4096);
    field(&P::min_contrast, "min_contrast", "1", "smallest contrast of a SIFT feature", 0.001, 0.2);
    field(&P::upright, "upright", "",
          "descriptors keep the image's vertical: more distinctive, for cameras that roll by less than 15 degrees");
  }
};

/// Factor by which an image of this width is reduced before the search, 1 or more.
int reduction(int width_px, const ViewKeypointParameters& parameters);

/// SIFT features of the left rectified image (CV_8UC1, of the camera's size), strongest first, spread over the columns.
/// Bearings are in the left rectified optical frame. Throws std::invalid_argument for an image of another size or type.
std::vector<landmarks::Keypoint> detect_view_keypoints(const cv::Mat& left, const vision::PinholeCamera& camera,
                                                       const ViewKeypointParameters& parameters);

/// Gives keypoints points in metres by their disparity in the right image, and removes those that have none: without a
/// match, or so far away that the disparity is noise.
void keep_measured(std::vector<landmarks::Keypoint>& keypoints, const cv::Mat& left, const cv::Mat& right,
                   const vision::RectifiedStereo& stereo);

}  // namespace panvo::stereo_places
