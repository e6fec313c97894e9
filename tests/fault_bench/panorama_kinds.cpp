// SPDX-License-Identifier: Apache-2.0
// Faults of the panoramic camera.
#include <opencv2/imgproc.hpp>

#include "kinds.hpp"
#include "passages.hpp"

namespace panvo::test {
namespace {

Fault frozen(Draw&, const FaultWindow&) {
  return {.panoramas = [held = cv::Mat()](const Panorama& panorama, const Moment& moment) mutable {
    if (!moment.is_on || held.empty()) held = panorama.pixels;
    return std::vector<Panorama>{{panorama.stamp_ns, held}};
  }};
}

Fault black(Draw&, const FaultWindow&) {
  return {.panoramas = each_panorama([](cv::Mat& image, const Moment&) { image.setTo(cv::Scalar::all(0)); })};
}

/// The camera hangs from its mount: rotated by 180 degrees about the forward axis.
Fault upside_down(Draw&, const FaultWindow&) {
  return {.panoramas = each_panorama([](cv::Mat& image, const Moment&) { cv::flip(image, image, -1); })};
}

Fault mirrored(Draw&, const FaultWindow&) {
  return {.panoramas = each_panorama([](cv::Mat& image, const Moment&) { cv::flip(image, image, 1); })};
}

/// The camera is rotated on its mount: columns are shifted cyclically.
Fault turned(Draw& draw, const FaultWindow&) {
  const double turns = draw.sign() * draw.uniform(5.0, 60.0) / 360.0;
  return {.panoramas = each_panorama([turns](cv::Mat& image, const Moment&) {
            const int columns = (static_cast<int>(turns * image.cols) + image.cols) % image.cols;
            cv::Mat moved(image.size(), image.type());
            image.colRange(0, image.cols - columns).copyTo(moved.colRange(columns, image.cols));
            image.colRange(image.cols - columns, image.cols).copyTo(moved.colRange(0, columns));
            image = moved;
          })};
}

Fault clock_off(Draw& draw, const FaultWindow&) {
  const auto by_ns = static_cast<std::int64_t>(draw.sign()) * 200'000'000;
  return {.panoramas = altered<Panorama>([by_ns](Panorama& panorama, const Moment&) { panorama.stamp_ns += by_ns; })};
}

Fault half_covered(Draw& draw, const FaultWindow&) {
  const double from = draw.uniform(0.0, 0.5);
  return {.panoramas = each_panorama([from](cv::Mat& image, const Moment&) {
            const int first = static_cast<int>(from * image.cols);
            image.colRange(first, first + image.cols / 2).setTo(cv::Scalar::all(20));
          })};
}

Fault missing(Draw&, const FaultWindow&) { return {.panoramas = stopped<Panorama>()}; }

}  // namespace

std::vector<FaultKind> panorama_kinds() {
  return {
      {"panorama_frozen", "the panoramic camera repeats the same image", Lasting::kWhile, frozen},
      {"panorama_black", "the panorama is black", Lasting::kWhile, black},
      {"panorama_missing", "no panoramas", Lasting::kWhile, missing},
      {"panorama_upside_down", "the panorama is upside down", Lasting::kWhile, upside_down},
      {"panorama_mirrored", "the panorama is mirrored", Lasting::kWhile, mirrored},
      {"panorama_turned", "the panoramic camera is rotated on its mount by 5 to 60 degrees", Lasting::kOnward, turned},
      {"panorama_clock", "panoramas are stamped 200 ms early or late", Lasting::kOnward, clock_off},
      {"panorama_covered", "half of the panorama is covered", Lasting::kOnward, half_covered},
  };
}

}  // namespace panvo::test
