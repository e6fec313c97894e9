// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace panvo::vision {

/// The grey levels of an 8-bit image, grey or BGR, as a new 8-bit image. A grey image is not copied: the result shares
/// its pixels.
cv::Mat to_grey(const cv::Mat& image);

}  // namespace panvo::vision
