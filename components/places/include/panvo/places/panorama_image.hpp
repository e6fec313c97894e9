// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::places {

/// Rows of a panorama that does not cover the whole sphere.
struct ElevationRange {
  double top_deg = 0.0;     ///< of the upper edge, above the horizon
  double bottom_deg = 0.0;  ///< of the lower edge, below the horizon
};

/// A full turn of 1080x540, whatever the size of the file was.
struct PanoramaImage {
  cv::Mat grey;          ///< CV_8UC1; rows beyond the file's repeat its edge
  cv::Mat seen;          ///< CV_8UC1: 255 where the file has pixels that are not masked
  int file_columns = 0;  ///< px
};

/// Fits an image to a full turn. Its width is always 360 degrees. Rows: `range`, else the whole sphere for 2:1, else square
/// pixels about the horizon (120x25 px: 37.5 degrees to either side). `mask`: any size, CV_8UC1, 0 on the vehicle; empty:
/// none. On failure, `fault` says why; the image is then empty.
struct FittedPanorama {
  PanoramaImage image;
  std::optional<std::string> fault;
};
FittedPanorama fit_panorama(const cv::Mat& image, const std::optional<ElevationRange>& range, const cv::Mat& mask);

/// The same for a file.
FittedPanorama read_panorama(const std::filesystem::path& file, const std::optional<ElevationRange>& range,
                             const cv::Mat& mask);

}  // namespace panvo::places
