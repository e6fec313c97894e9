// SPDX-License-Identifier: Apache-2.0
// What stands between the world and the stereo cameras.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "kinds.hpp"
#include "passages.hpp"

namespace panvo::test {
namespace {

/// Smooth random blotches with values 0..255.
cv::Mat blotches(cv::RNG& rng, cv::Size size, int blotch_px, int type) {
  cv::Mat coarse(std::max(2, size.height / blotch_px), std::max(2, size.width / blotch_px),
                 CV_MAKETYPE(CV_8U, CV_MAT_CN(type)));
  rng.fill(coarse, cv::RNG::UNIFORM, 0, 256);
  cv::Mat fine;
  cv::resize(coarse, fine, size, 0, 0, cv::INTER_CUBIC);
  return fine;
}

/// A textured plane, like the side of a bus, passes in front of both cameras and fills most of the view, with
/// consistent disparity.
Fault mover(Draw& draw, const FaultWindow& window) {
  struct Plane {
    double disparity_share;  // of the image width
    double speed_shares_s;   // image widths per second
    double width_shares;
    cv::Mat texture;
  };
  const auto seed = draw.seed();
  Plane plane{draw.uniform(0.02, 0.06), draw.sign() * draw.uniform(0.3, 0.8), 4.0, {}};
  return {.pairs = both_eyes([plane, seed, window](cv::Mat& image, const Moment& moment, int eye) mutable {
            const cv::Size size = image.size();
            if (plane.texture.empty()) {
              cv::RNG rng(seed);
              const cv::Size whole(static_cast<int>(plane.width_shares * size.width), size.height);
              plane.texture = blotches(rng, whole, 6, image.type());
            }
            // In image widths; the plane is centred at half time of the fault.
            const double middle_s = 0.5 * (window.from_s + window.to_s);
            const double centre = 0.5 + plane.speed_shares_s * (moment.t_s - middle_s);
            const double left_edge = (centre - 0.5 * plane.width_shares) * size.width;
            const double shift = left_edge - eye * plane.disparity_share * size.width;
            const cv::Matx23d place(1, 0, shift, 0, 1, 0);
            cv::Mat seen, mask;
            cv::warpAffine(plane.texture, seen, place, size, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
            cv::warpAffine(cv::Mat(plane.texture.size(), CV_8U, cv::Scalar(255)), mask, place, size, cv::INTER_NEAREST,
                           cv::BORDER_CONSTANT);
            // Strips at the top and bottom stay uncovered.
            mask.rowRange(0, size.height / 10) = 0;
            mask.rowRange(size.height - size.height / 10, size.height) = 0;
            seen.copyTo(image, mask);
          })};
}

Fault rain(Draw& draw, const FaultWindow&) {
  const int drops = draw.integer(300, 900);
  const double slant = draw.uniform(-0.3, 0.3);
  return {.pairs = both_eyes([rng = draw.image_noise(), drops, slant](cv::Mat& image, const Moment&, int) mutable {
            cv::Mat streaks = image.clone();
            for (int i = 0; i < drops; ++i) {
              const cv::Point from(rng.uniform(0, image.cols), rng.uniform(0, image.rows));
              const int length = rng.uniform(10, 40);
              const cv::Point to(from.x + static_cast<int>(slant * length), from.y + length);
              cv::line(streaks, from, to, cv::Scalar::all(220), rng.uniform(1, 3), cv::LINE_AA);
            }
            cv::addWeighted(image, 0.4, streaks, 0.6, 0.0, image);
          })};
}

/// Reduces contrast, most at the horizon, where the path through the fog is longest.
Fault fog(Draw& draw, const FaultWindow&) {
  const double densest = draw.uniform(0.85, 0.98);
  return {.pairs = both_eyes([densest](cv::Mat& image, const Moment&, int) {
            for (int row = 0; row < image.rows; ++row) {
              const double below = std::max(0.0, (row - 0.5 * image.rows) / (0.5 * image.rows));
              const double veil = densest * (1.0 - 0.5 * below);
              cv::Mat line = image.row(row);
              line.convertTo(line, -1, 1.0 - veil, 190.0 * veil);
            }
          })};
}

/// Static smudges, different on each lens.
Fault lens_dirt(Draw& draw, const FaultWindow&) {
  const auto seed = draw.seed();
  const double covered = draw.uniform(0.3, 0.6);
  return {.pairs = both_eyes([seed, covered](cv::Mat& image, const Moment&, int eye) {
            cv::RNG rng(seed + static_cast<std::uint64_t>(eye));
            const cv::Mat dirt = blotches(rng, image.size(), 60, CV_8U);
            cv::Mat veiled;
            cv::blur(image, veiled, cv::Size(31, 31));
            veiled.convertTo(veiled, -1, 0.4, 30.0);
            veiled.copyTo(image, dirt < 255.0 * covered);
          })};
}

Fault blurred(Draw& draw, const FaultWindow&) {
  const double deviation_px = draw.uniform(3.0, 8.0);
  return {.pairs = both_eyes([deviation_px](cv::Mat& image, const Moment&, int) {
            cv::GaussianBlur(image, image, cv::Size(), deviation_px);
          })};
}

}  // namespace

std::vector<FaultKind> optics_kinds() {
  return {
      {"mover", "a passing textured plane fills the view of both cameras", Lasting::kWhile, mover},
      {"rain", "rain streaks, different in each camera", Lasting::kWhile, rain},
      {"fog", "dense fog", Lasting::kWhile, fog},
      {"lens_dirt", "smudges on both lenses", Lasting::kOnward, lens_dirt},
      {"blurred", "both cameras are out of focus", Lasting::kWhile, blurred},
  };
}

}  // namespace panvo::test
