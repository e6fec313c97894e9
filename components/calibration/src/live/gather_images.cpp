// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "image_stream.hpp"
#include "interruption.hpp"
#include "live_images.hpp"
#include "messages/grey_picture.hpp"
#include "panvo/calibration/board_detector.hpp"
#include "panvo/calibration/calibration_error.hpp"

namespace panvo::calibration {
namespace {

namespace fs = std::filesystem;
using Clock = ImageStream::Clock;

constexpr std::chrono::seconds kReminder{5};  // interval after which the progress is printed again

/// Detects the board in incoming images and writes those of the kept views.
class Gathering {
 public:
  Gathering(const LiveImages& settings, const Board& board, const std::vector<CameraTopic>& cameras)
      : settings_(settings), board_(board), cameras_(cameras), detector_(board) {}

  void take(const ImageStream::Set& set) {
    if (!stamps_.insert(set.stamp_ns).second) return;  // seen before: the recording is being replayed
    std::vector<cv::Mat> pictures;
    std::vector<std::vector<Corner>> seen;
    for (std::size_t camera = 0; camera < cameras_.size(); ++camera) {
      const auto& sample = set.frames[camera];
      pictures.push_back(grey_picture(cameras_[camera].topic, *sample->type(), sample->message()));
      auto sighting = detector_.detect(pictures.back());
      seen.push_back(std::move(sighting.corners));
      if (!sighting.missing.empty()) missing_ = cameras_[camera].name + ": " + sighting.missing;
    }
    begin_with_sizes_of(pictures);
    is_seen_ = std::any_of(seen.begin(), seen.end(), [](const auto& corners) { return !corners.empty(); });
    if (choice_->offer(seen)) {
      keep(set.stamp_ns, pictures);
      say("");
    } else if (Clock::now() - said_ > kReminder) {
      say(is_seen_ ? ", nothing new" : ", no camera sees the board (" + missing_ + ")");
    }
  }

  std::size_t kept() const { return choice_ ? choice_->kept() : 0; }
  bool is_enough() const { return choice_ && choice_->is_enough(); }
  const std::string& missing() const { return missing_; }

 private:
  void begin_with_sizes_of(const std::vector<cv::Mat>& pictures) {
    std::vector<std::string> names;
    std::vector<cv::Size> sizes;
    for (std::size_t camera = 0; camera < cameras_.size(); ++camera) {
      names.push_back(cameras_[camera].name);
      sizes.push_back(pictures[camera].size());
    }
    if (!choice_) {
      sizes_ = sizes;
      choice_.emplace(names, sizes, board_, settings_.goals);
    }
    if (sizes != sizes_) throw CalibrationError("the image size changed; use images of one size");
  }

  void keep(std::int64_t stamp_ns, const std::vector<cv::Mat>& pictures) const {
    for (std::size_t camera = 0; camera < cameras_.size(); ++camera) {
      const fs::path folder = settings_.out / cameras_[camera].name;
      const fs::path file = folder / fmt::format("{}.png", stamp_ns);
      std::error_code error;
      fs::create_directories(folder, error);
      if (error || !cv::imwrite(file.string(), pictures[camera]))
        throw CalibrationError(file.string() + ": cannot be written; choose a writable folder with --out");
    }
  }

  /// Prints "view 12: left (61 % covered) needs the top, 8 more views; right (78 % covered) is complete".
  void say(const std::string& news) {
    std::vector<std::string> parts;
    for (std::size_t camera = 0; camera < cameras_.size(); ++camera) {
      const auto lacks = choice_->lacks(camera);
      parts.push_back(fmt::format("{} ({:.0f} % covered) {}", cameras_[camera].name, 100.0 * choice_->covered(camera),
                                  lacks.empty() ? "is complete" : fmt::format("needs {}", fmt::join(lacks, ", "))));
    }
    fmt::print(stderr, "view {}{}: {}\n", choice_->kept(), news, fmt::join(parts, "; "));
    said_ = Clock::now();
  }

  const LiveImages& settings_;
  const Board& board_;
  const std::vector<CameraTopic>& cameras_;
  BoardDetector detector_;
  std::set<std::int64_t> stamps_;
  std::vector<cv::Size> sizes_;
  std::optional<ViewChoice> choice_;  // created with the first images, since it needs their sizes
  bool is_seen_ = false;
  std::string missing_;  // the last reason why a camera did not see the board
  Clock::time_point said_ = Clock::now();
};

Clock::duration seconds(double count) { return std::chrono::milliseconds(std::llround(1e3 * count)); }

/// Collects images. Returns the reason for stopping.
const char* gather(ImageStream& stream, const LiveImages& settings, Gathering& gathering) {
  const auto end = Clock::now() + seconds(settings.limit_s);
  bool has_come = false;
  while (!gathering.is_enough()) {
    if (gathering.kept() >= settings.max_views) return "limit of --views reached";
    const auto set = stream.next(std::min(end, Clock::now() + seconds(settings.timeout_s)));
    if (Interruption::came()) return "stopped by Ctrl-C";
    if (Clock::now() >= end) return "time limit of --for reached";
    if (!set && !has_come) throw CalibrationError(stream.why_none());
    if (!set) return "no more images arrive";
    has_come = true;
    gathering.take(*set);
  }
  return "enough";
}

}  // namespace

void gather_images(const LiveImages& settings, const Board& board) {
  const auto cameras = parse_topics(settings.topics, settings.names);
  std::error_code error;
  if (fs::exists(settings.out, error) && !fs::is_empty(settings.out, error))
    throw CalibrationError(
        settings.out.string() +
        ": already contains images; calibrate from it without --topics, remove it, or choose another --out");
  const Interruption interruption;
  Gathering gathering(settings, board, cameras);
  ImageStream stream(cameras, std::chrono::milliseconds(std::llround(1e3 * settings.timeout_s)),
                     std::llround(1e6 * settings.tolerance_ms));
  fmt::print(stderr, "move the board in front of the cameras; Ctrl-C stops\n");
  const char* why = gather(stream, settings, gathering);
  if (gathering.kept() == 0)
    throw CalibrationError(fmt::format("no view of the board ({}): {}", why,
                                       gathering.missing().empty() ? "no images arrived" : gathering.missing()));
  fmt::print(stderr, "{} views in {}: {}\n", gathering.kept(), settings.out.string(), why);
}

}  // namespace panvo::calibration
