// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_video.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "drive_map.hpp"
#include "left_images.hpp"
#include "panorama_pair.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "video_encoder.hpp"

namespace panvo::evaluation {
namespace {

constexpr int kFramesPerSecond = 25;
constexpr double kPlaceShown_s = 1.5;  // of the video
constexpr double kStale_s = 1.0;       // of the drive: images are not shown longer

// Left: the plan. Right, from above: left image, panorama, recognised place. Below: two lines of text.
const cv::Size kPicture(1280, 720);
const cv::Rect kPlan(0, 0, 640, 656);
const cv::Rect kLeft(648, 4, 628, 330);
const cv::Rect kAround(648, 360, 628, 136);
const cv::Rect kPlace(648, 520, 628, 136);
constexpr int kLines_y = 682, kLine_px = 26;

const cv::Scalar kText(40, 40, 40);

void write(cv::Mat3b& picture, const std::string& text, cv::Point at, const cv::Scalar& colour = kText) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.55, colour, 1, cv::LINE_AA);
}

/// Scales the image to fit into the box, and centres it.
void show(const cv::Mat& image, const cv::Rect& box, cv::Mat3b& picture) {
  const double scale =
      std::min(static_cast<double>(box.width) / image.cols, static_cast<double>(box.height) / image.rows);
  const cv::Size size(std::max(1, static_cast<int>(image.cols * scale)),
                      std::max(1, static_cast<int>(image.rows * scale)));
  const cv::Rect place(box.x + (box.width - size.width) / 2, box.y + (box.height - size.height) / 2, size.width,
                       size.height);
  cv::resize(image, picture(place), size, 0, 0, cv::INTER_AREA);
}

/// The latest element not after the stamp, as an iterator; `end` before the first.
template <class Items>
auto latest(const Items& items, std::int64_t stamp_ns) {
  const auto after = std::ranges::upper_bound(items, stamp_ns, {}, [](const auto& item) { return item.stamp_ns; });
  return after == items.begin() ? items.end() : std::prev(after);
}

double horizontal_m(const PoseError& error) { return error.translation_m.head<2>().norm(); }

/// A recognised place: the panorama of its landmark, turned to the vehicle's heading.
struct Recognised {
  const RecordedPanorama* panorama;
  double heading_rad;
  std::int64_t landmark;
};

std::optional<Recognised> recognised(const JourneyFrames& frames, const AppliedCorrection& correction) {
  const auto& landmarks = frames.run.landmarks;
  const auto landmark = std::ranges::find(landmarks, correction.landmark, &RunLandmark::id);
  const auto match = std::ranges::find_if(frames.run.matches, [&](const RunMatch& one) {
    return one.stamp_ns == correction.stamp_ns && one.landmark == correction.landmark && one.heading_rad;
  });
  if (landmark == landmarks.end() || match == frames.run.matches.end()) return std::nullopt;
  const auto* panorama = panorama_near(frames.recording, landmark->stamp_ns);
  if (!panorama && frames.earlier != nullptr) panorama = panorama_near(*frames.earlier, landmark->stamp_ns);
  if (!panorama) return std::nullopt;
  return Recognised{panorama, *match->heading_rad, correction.landmark};
}

/// Composes the pictures of the video.
class Film {
 public:
  Film(const RunEvaluation& run, double speed)
      : run_(run), speed_(speed), map_(run, kPlan.size()), left_(left_images(run.frames.recording)) {}

  cv::Mat3b at(std::int64_t stamp_ns) {
    cv::Mat3b picture(kPicture, cv::Vec3b(255, 255, 255));
    map_.at(stamp_ns).copyTo(picture(kPlan));
    show_left(stamp_ns, picture);
    show_panorama(stamp_ns, picture);
    show_place(stamp_ns, picture);
    write_lines(stamp_ns, picture);
    return picture;
  }

 private:
  void show_left(std::int64_t stamp_ns, cv::Mat3b& picture) const {
    const auto frame = latest(left_, stamp_ns);
    if (frame == left_.end() || seconds_since(frame->stamp_ns, stamp_ns) > kStale_s) return;
    const cv::Mat image = cv::imread(frame->left.string(), cv::IMREAD_COLOR);
    if (image.empty()) throw InputError(frame->left, "cannot be decoded as an image", "record it again or remove it");
    show(image, kLeft, picture);
  }

  void show_panorama(std::int64_t stamp_ns, cv::Mat3b& picture) const {
    const auto& panoramas = run_.frames.recording.panoramas;
    const auto panorama = latest(panoramas, stamp_ns);
    if (panorama == panoramas.end() || seconds_since(panorama->stamp_ns, stamp_ns) > kStale_s) return;
    write(picture, "panorama", {kAround.x, kAround.y - 6});
    show(panorama_band(panorama->file), kAround, picture);
  }

  void show_place(std::int64_t stamp_ns, cv::Mat3b& picture) const {
    const auto& applied = run_.revisits.applied;
    const auto correction = latest(applied, stamp_ns);
    if (correction == applied.end() || seconds_since(correction->stamp_ns, stamp_ns) > kPlaceShown_s * speed_) return;
    const auto place = recognised(run_.frames, *correction);
    if (!place) return;
    write(picture,
          fmt::format("recognised: landmark {}, corrected by {:.2f} m", place->landmark,
                      (correction->after_position_m - correction->before_position_m).norm()),
          {kPlace.x, kPlace.y - 6}, video_colours::correction());
    show(panorama_band(place->panorama->file, -place->heading_rad), kPlace, picture);
  }

  void write_lines(std::int64_t stamp_ns, cv::Mat3b& picture) const {
    const auto& frames = run_.frames;
    const auto state = latest(frames.run.states, stamp_ns);
    const auto stereo = latest(run_.paths.binocular.errors, stamp_ns);
    const auto enhanced = latest(run_.paths.enhanced.errors, stamp_ns);
    const std::int64_t start_ns = run_.paths.binocular.errors.front().stamp_ns;
    std::string first = fmt::format("{:.1f} s", std::max(0.0, seconds_since(start_ns, stamp_ns)));
    if (stereo != run_.paths.binocular.errors.end()) first += fmt::format("   {:.0f} m", stereo->distance_m);
    if (state != frames.run.states.end()) first += "   " + state->state;
    first += fmt::format("   x{:g}", speed_);
    write(picture, first, {12, kLines_y});
    int x_px = 12;
    const auto add = [&](const std::string& text, const cv::Scalar& colour) {
      write(picture, text, {x_px, kLines_y + kLine_px}, colour);
      x_px += 300;
    };
    if (stereo != run_.paths.binocular.errors.end()) {
      add(fmt::format("odometry: {:.2f} m off", horizontal_m(*stereo)), video_colours::binocular());
    }
    if (enhanced != run_.paths.enhanced.errors.end()) {
      add(fmt::format("enhanced: {:.2f} m off", horizontal_m(*enhanced)), video_colours::enhanced());
    }
    add("ground truth", cv::Scalar(150, 150, 150));
    add("landmarks", video_colours::landmark());
  }

  static double seconds_since(std::int64_t from_ns, std::int64_t to_ns) {
    return static_cast<double>(to_ns - from_ns) * 1e-9;
  }

  const RunEvaluation& run_;
  const double speed_;
  DriveMap map_;
  std::vector<dataset_player::StereoFrame> left_;
};

}  // namespace

void write_video(const RunEvaluation& run, const std::filesystem::path& file, double speed) {
  VideoEncoder encoder(file, kPicture, kFramesPerSecond);
  Film film(run, speed);
  const auto& poses = run.frames.run.binocular.poses;
  const auto step_ns = static_cast<std::int64_t>(speed / kFramesPerSecond * 1e9);
  for (std::int64_t stamp_ns = poses.front().stamp_ns; stamp_ns <= poses.back().stamp_ns; stamp_ns += step_ns) {
    encoder.add(film.at(stamp_ns));
  }
  const cv::Mat3b last = film.at(poses.back().stamp_ns);
  for (int i = 0; i < kFramesPerSecond; ++i) encoder.add(last);  // a second to look at the result
  encoder.finish();
}

}  // namespace panvo::evaluation
