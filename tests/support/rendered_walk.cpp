// SPDX-License-Identifier: Apache-2.0
#include "rendered_walk.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace panvo::test {
namespace {

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFocal_px = 240, kBaseline_m = 0.2, kStep_m = 0.1, kInterval_s = 0.1;
constexpr double kTexel_m = 0.02;

/// Smooth random speckles; deterministic.
cv::Mat texture(int seed) {
  cv::Mat noise(1024, 1024, CV_8U);
  cv::RNG random(seed);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {}, 1.5);
  cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
  return noise;
}

/// A corridor seen from (x, 0, z): floor 1 m below the camera, ceiling 2 m above, walls 2 m to either side, end 30 m from the start.
cv::Mat render(const cv::Mat textures[3], double x, double z) {
  cv::Mat map_u(kHeight, kWidth, CV_32F), map_v(kHeight, kWidth, CV_32F);
  cv::Mat which(kHeight, kWidth, CV_8U);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const double dx = (column - kWidth / 2) / kFocal_px, dy = (row - kHeight / 2) / kFocal_px;
      const double side = dx == 0 ? std::numeric_limits<double>::infinity() : ((dx > 0 ? 2.0 : -2.0) - x) / dx;
      const double level = dy == 0 ? std::numeric_limits<double>::infinity() : (dy > 0 ? 1.0 : -2.0) / dy;
      const double depth = std::min({side, level, 30.0 - z});
      const double px = x + dx * depth, py = dy * depth, pz = z + depth;
      const int surface = depth == side ? 0 : depth == level ? 1 : 2;
      which.at<uchar>(row, column) = static_cast<uchar>(surface);
      map_u.at<float>(row, column) = static_cast<float>(std::fmod((surface == 0 ? pz : px + 100) / kTexel_m, 1000.0));
      map_v.at<float>(row, column) = static_cast<float>(
          std::fmod((surface == 1 ? pz + 100 * dy / std::abs(dy) : py + 100) / kTexel_m + 2e4, 1000.0));
    }
  }
  cv::Mat image(kHeight, kWidth, CV_8U, cv::Scalar(0));
  for (int surface = 0; surface < 3; ++surface) {
    cv::Mat seen;
    cv::remap(textures[surface], seen, map_u, map_v, cv::INTER_LINEAR, cv::BORDER_WRAP);
    seen.copyTo(image, which == surface);
  }
  return image;
}

}  // namespace

void RenderedWalk::write(const std::filesystem::path& folder) const {
  std::filesystem::create_directories(folder / "image_0");
  std::filesystem::create_directories(folder / "image_1");
  std::ofstream(folder / "calib.txt") << "P0: 240 0 160 0 0 240 120 0 0 0 1 0\nP1: 240 0 160 "
                                      << -kFocal_px * kBaseline_m << " 0 240 120 0 0 0 1 0\n";
  std::ofstream times(folder / "times.txt"), poses(folder / "poses.txt");
  const cv::Mat textures[3] = {texture(1), texture(2), texture(3)};
  for (int frame = 0; frame < frames; ++frame) {
    times << frame * kInterval_s << "\n";
    poses << "1 0 0 0 0 1 0 0 0 0 1 " << frame * kStep_m << "\n";
    cv::Mat left = render(textures, 0, frame * kStep_m), right = render(textures, kBaseline_m, frame * kStep_m);
    spoil(frame, left, right);
    char name[16];
    std::snprintf(name, sizeof name, "%06d.png", frame);
    if (!left.empty()) cv::imwrite((folder / "image_0" / name).string(), left);
    if (!right.empty()) cv::imwrite((folder / "image_1" / name).string(), right);
  }
}

}  // namespace panvo::test
