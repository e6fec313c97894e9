// SPDX-License-Identifier: Apache-2.0
// Runs panvo_calibrate on live topics with rendered images of a board.
#include <gmock/gmock.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <functional>
#include <mutex>
#include <thread>

#include "panvo/calibration/rig_file.hpp"
#include "panvo/calibration/view_choice.hpp"
#include "panvo/calibration_files/stereo_pair.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/test_domain.hpp"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "written_images.hpp"

namespace panvo::calibration {
namespace {

using runtime::SamplePtr;
using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kFrame_ns = 50'000'000;
constexpr const char* kBoard = "chessboard:9x6:0.04";
const cv::Mat kGrey(48, 64, CV_8U, cv::Scalar(9));
const std::vector<std::string> kNames{"left", "right"};

/// Board poses that reach the goals of ViewChoice: for each camera in the middle and at all sides of the image.
std::vector<Eigen::Isometry3d> well_held(const Board& board, const std::vector<RigCamera>& cameras) {
  std::mt19937 random(11);
  std::vector<Eigen::Isometry3d> held;
  for (const auto& camera : cameras) {
    const auto hold = [&](double off_deg, double azimuth_deg, double distance_m, double tilt_deg) {
      held.push_back(
          test::hold_board(board, camera.camera_from_reference, off_deg, azimuth_deg, distance_m, tilt_deg, random));
    };
    for (const double azimuth_deg : {0.0, 180.0}) hold(21.0, azimuth_deg, 0.6, 15.0);
    for (const double azimuth_deg : {90.0, 270.0}) hold(17.0, azimuth_deg, 0.6, 15.0);
    for (const double azimuth_deg : {35.0, 145.0, 215.0, 325.0}) hold(22.0, azimuth_deg, 0.6, 20.0);
    for (const double azimuth_deg : {60.0, 180.0, 300.0}) hold(6.0, azimuth_deg, 0.5, 40.0);
    for (const double azimuth_deg : {0.0, 120.0, 240.0}) hold(8.0, azimuth_deg, 0.9, 40.0);
  }
  const auto seen = test::observe(board, cameras, held, 0.0, 1);
  ViewChoice choice(kNames, seen.image_sizes, board, {20, 12, 0.8, 0.4, 4, 1.6});
  std::vector<Eigen::Isometry3d> chosen;  // what one camera is shown may be like what the other has seen
  for (std::size_t view = 0; view < held.size(); ++view) {
    if (choice.offer(seen.views[view].seen)) chosen.push_back(held[view]);
  }
  EXPECT_TRUE(choice.is_enough());
  return chosen;
}

class LiveCalibration : public test::CommandTest {
 protected:
  using Frame = std::function<SamplePtr(std::size_t camera, std::size_t number, std::int64_t stamp_ns)>;

  static void SetUpTestSuite() { setenv("ROS_DOMAIN_ID", std::to_string(runtime::test_domain()).c_str(), 1); }

  static std::vector<RigCamera> truth() { return test::stereo_pair(test::plumb_bob()); }

  /// Images of the boards, by camera.
  static const std::vector<cv::Mat>& pictures(std::size_t camera) {
    static const auto rendered = [] {
      const Board board = parse_board(kBoard);
      const auto cameras = truth();
      const auto held = well_held(board, cameras);
      std::vector<std::vector<cv::Mat>> all(cameras.size());
      for (std::size_t i = 0; i < cameras.size(); ++i) {
        const test::BoardRenderer renderer(board, cameras[i].lens);
        for (const auto& pose : held)
          all[i].push_back(
              renderer.render(cameras[i].camera_from_reference * pose, static_cast<unsigned>(100 * all[i].size() + i)));
      }
      return all;
    }();
    return rendered[camera];
  }

  ~LiveCalibration() override { stop(); }

  template <class Message>
  void open(const std::string& topic) {
    const auto& type = interfaces::message_type<Message>();
    writers_.push_back(bridge_->open_writer({topic, std::string(type.name), interfaces::qos::kSensorData, &type}));
  }

  template <class Message>
  static SamplePtr sample(std::shared_ptr<Message> message, std::int64_t stamp_ns) {
    return runtime::Sample::of(interfaces::message_type<Message>(), std::move(message), stamp_ns);
  }
  static SamplePtr picture(std::size_t camera, std::size_t number, std::int64_t stamp_ns) {
    return image(pictures(camera)[number % pictures(camera).size()], stamp_ns);
  }
  static SamplePtr image(const cv::Mat& picture, std::int64_t stamp_ns) {
    auto message = conversions::make_image(stamp_ns, "camera", "mono8", picture.cols, picture.rows);
    picture.copyTo(conversions::pixels(*message));
    return sample(std::move(message), stamp_ns);
  }
  static SamplePtr compressed(const cv::Mat& picture, std::int64_t stamp_ns) {
    auto message = std::make_shared<CompressedImage>();
    message->header() = conversions::make_image(stamp_ns, "camera", "mono8", 1, 1)->header();
    message->format("png");
    cv::imencode(".png", picture, message->data());
    return sample(std::move(message), stamp_ns);
  }

  /// Publishes frames on the open writers, one after the other, until stop().
  void play(const Frame& frame) {
    player_ = std::jthread([this, frame](const std::stop_token& stopped) {
      std::mutex mutex;
      std::unique_lock lock(mutex);
      std::condition_variable_any camera_clock;
      for (std::int64_t i = 0; !stopped.stop_requested(); ++i) {
        for (std::size_t camera = 0; camera < writers_.size(); ++camera)
          writers_[camera]->write(frame(camera, static_cast<std::size_t>(i), (i + 1) * kFrame_ns));
        camera_clock.wait_for(lock, stopped, std::chrono::nanoseconds(kFrame_ns), [] { return false; });
      }
    });
  }
  void stop() { player_ = {}; }

  /// Starts the command, interrupts it when it prints `words`, and waits for its end.
  test::Outcome interrupt(const std::string& arguments, const std::string& words) const {
    const std::string command = "cd '" + folder_.path().string() + "' && echo $$ && exec " PANVO_CALIBRATE " " +
                                arguments + " 2>&1 > out.txt < /dev/null";
    std::FILE* said = popen(command.c_str(), "r");
    std::string err;
    pid_t process = 0;
    char line[4096];
    while (std::fgets(line, sizeof line, said) != nullptr) {
      if (process == 0) {
        process = std::stoi(line);
        continue;
      }
      const bool is_said = err.find(words) != std::string::npos;
      err += line;
      if (!is_said && err.find(words) != std::string::npos) kill(process, SIGINT);
    }
    const int status = pclose(said);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, folder_.read("out.txt"), err};
  }

  std::unique_ptr<runtime::Bridge> bridge_ =
      runtime::make_dds_bridge({.domain = runtime::test_domain(), .profiles = "", .name = "cameras"});
  std::vector<std::unique_ptr<runtime::BridgeWriter>> writers_;
  std::jthread player_;
};

TEST_F(LiveCalibration, OfAPairEndsWhenTheBoardWasSeenEnoughAndCanBeRepeatedFromItsPictures) {
  open<Image>("/left/image_raw");
  open<Image>("/right/image_raw");
  play(picture);
  const auto outcome =
      call("stereo --topics /left/image_raw /right/image_raw --board chessboard:9x6:0.04 --out rig --timeout 30");
  stop();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("view 1: left ("), HasSubstr("needs"), HasSubstr("views in rig/images: enough")));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("reprojection rms"), HasSubstr("rig: left.yaml, right.yaml")));
  const auto cameras = truth();
  const auto [left, right, right_from_left] =
      calibration_files::stereo_pair(calibration_files::read_camera_info(folder_ / "rig/left.yaml"),
                                     calibration_files::read_camera_info(folder_ / "rig/right.yaml"))
          .calibration;
  test::expect_same_focal_lengths(left, cameras[0].lens);
  test::expect_same_focal_lengths(right, cameras[1].lens);
  test::expect_same_pose(right_from_left, cameras[1].camera_from_reference);

  const auto again = call("stereo rig/images --board chessboard:9x6:0.04 --out again");
  ASSERT_EQ(again.status, 0) << again.err;
  for (const char* file : {"left.yaml", "right.yaml", "report.html", "residuals_left.svg", "coverage_right.svg"}) {
    EXPECT_THAT(folder_.read(std::string("rig/") + file), ::testing::Not(IsEmpty())) << file;
    EXPECT_EQ(folder_.read(std::string("rig/") + file), folder_.read(std::string("again/") + file)) << file;
  }
}

TEST_F(LiveCalibration, OfARigUsesWhatWasSeenWhenCtrlCComes) {
  open<Image>("/left/image_raw");
  open<CompressedImage>("/right/image_raw/compressed");
  play([](std::size_t camera, std::size_t i, std::int64_t stamp_ns) {
    return camera == 0 ? picture(0, i, stamp_ns) : compressed(pictures(1)[i % pictures(1).size()], stamp_ns);
  });
  const auto outcome = interrupt(
      "rig --topics eye:=left/image_raw,/right/image_raw/compressed --board chessboard:9x6:0.04 --out rig --timeout 30",
      "view 12:");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("views in rig/images: stopped by Ctrl-C"));
  const auto found = read_extrinsics(folder_ / "rig/extrinsics.yaml");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "eye");
  EXPECT_EQ(found[1].name, "right");
}

TEST_F(LiveCalibration, EndsAfterAsManyViewsAsAreAskedFor) {
  open<Image>("/left/image_raw");
  open<Image>("/right/image_raw");
  play(picture);
  const auto outcome = call(
      "stereo --topics left:=/left/image_raw,right:=/right/image_raw --board chessboard:9x6:0.04 --out rig --views 3 "
      "--timeout 30");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("3 views in rig/images: limit of --views reached"),
                                 HasSubstr(" of 3 images, at least 5 are needed")));
  const auto once_more = call(
      "stereo --topics /left/image_raw /right/image_raw --board chessboard:9x6:0.04 --out rig --views 3 --timeout 30");
  EXPECT_EQ(once_more.status, 1);
  EXPECT_THAT(once_more.err, AllOf(HasSubstr("rig/images: already contains images"), HasSubstr("another --out")));
}

class LiveCalibrationRefuses : public LiveCalibration {
 protected:
  void expect_refusal(const std::string& arguments, const ::testing::Matcher<std::string>& words) const {
    const auto outcome = call("stereo --board chessboard:9x6:0.04 --out rig " + arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("panvo calibrate: "), words)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "rig")) << arguments;
  }
};

TEST_F(LiveCalibrationRefuses, TopicsThatNobodyPublishesAndNamesThoseThatThereAre) {
  expect_refusal("--topics /a /b --timeout 0.5",
                 AllOf(HasSubstr("/a: is not published"), HasSubstr("no images are published")));
  open<Image>("/left/image_raw");
  open<sensor_msgs::msg::CameraInfo>("/left/camera_info");
  expect_refusal("--topics /left/image_raw /right/image_raw --timeout 3",
                 AllOf(HasSubstr("/right/image_raw: is not published (image topics: /left/image_raw)"),
                       HasSubstr("ROS_DOMAIN_ID")));
  expect_refusal("--topics /left/image_raw /left/camera_info --timeout 3",
                 HasSubstr("/left/camera_info: has type sensor_msgs/msg/CameraInfo, which is not an image"));
}

TEST_F(LiveCalibrationRefuses, TopicsWithoutImages) {
  open<Image>("/left/image_raw");
  open<Image>("/right/image_raw");
  expect_refusal("--topics /left/image_raw /right/image_raw --timeout 3",
                 HasSubstr("/left/image_raw: is published, but no images arrived"));
}

TEST_F(LiveCalibrationRefuses, ImagesThatAreNeverTakenAtOnce) {
  open<Image>("/left/image_raw");
  open<Image>("/right/image_raw");
  play([](std::size_t camera, std::size_t, std::int64_t stamp_ns) {
    return image(kGrey, stamp_ns + (camera == 0 ? 0 : 20'000'000));
  });
  expect_refusal("--topics /left/image_raw /right/image_raw --timeout 3",
                 AllOf(HasSubstr("20.0 ms apart"), HasSubstr("--tolerance-ms")));
}

TEST_F(LiveCalibrationRefuses, ImagesWithoutTheBoard) {
  open<Image>("/left/image_raw");
  open<Image>("/right/image_raw");
  play([](std::size_t, std::size_t, std::int64_t stamp_ns) { return image(kGrey, stamp_ns); });
  expect_refusal("--topics /left/image_raw /right/image_raw --timeout 30 --for 3",
                 AllOf(HasSubstr("no view of the board"), HasSubstr("9 x 6 corners found")));
}

TEST_F(LiveCalibrationRefuses, CommandLinesWithNeitherOrBoth) {
  const std::string rest = " --board chessboard:9x6:0.04 --out rig";
  EXPECT_EQ(call("stereo" + rest).status, 2);
  EXPECT_THAT(folder_.read("err.txt"), HasSubstr("--topics"));
  EXPECT_EQ(call("stereo images" + rest + " --topics /a /b").status, 2);
  EXPECT_EQ(call("stereo images --views 3" + rest).status, 2);
}

}  // namespace
}  // namespace panvo::calibration
