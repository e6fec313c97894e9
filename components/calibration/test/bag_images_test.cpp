// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "bag/bag_images.hpp"
#include "bag/frame_choice.hpp"
#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration/image_sets.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/interfaces/qos.hpp"
#include "panvo/recorder/bag_writer.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "written_images.hpp"

namespace panvo::calibration {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kSecond = 1000 * kMillisecond;

TEST(FrameChoice, TakesOneFrameAnInterval) {
  EXPECT_THAT(choose_frames({0, 4, 9, 10, 25, 34, 35}, 10), ElementsAre(0, 10, 25, 35));
  EXPECT_THAT(choose_frames({7, 3, 3, 5}, 0), ElementsAre(3, 5, 7));
  EXPECT_THAT(choose_frames({}, 10), SizeIs(0));
}

TEST(FrameChoice, FindsTheNearestWithinTheTolerance) {
  EXPECT_EQ(nearest_frame({100, 200}, 103, 5), 100);
  EXPECT_EQ(nearest_frame({100, 200}, 197, 5), 200);
  EXPECT_EQ(nearest_frame({100, 106}, 104, 5), 106);
  EXPECT_EQ(nearest_frame({100, 200}, 150, 5), std::nullopt);
  EXPECT_EQ(nearest_frame({}, 150, 5), std::nullopt);
}

class ImagesOfABag : public test::CommandTest {
 protected:
  template <class Message>
  void add(recorder::BagWriter& bag, int topic, std::int64_t stamp_ns, const Message& message) const {
    const auto& type = interfaces::message_type<Message>();
    std::vector<std::uint8_t> bytes(type.serialized_size(&message));
    type.serialize(&message, bytes);
    bag.write(topic, stamp_ns, bytes);
  }

  /// Ten pairs per second for three seconds; right images 2 ms later and compressed, left ones raw.
  void record() const {
    recorder::BagWriter bag(folder_ / "bag");
    const int left = bag.add_topic(recorder::BagTopic::of(
        "/stereo/left/image_raw", interfaces::message_type<sensor_msgs::msg::Image>(), interfaces::qos::kSensorData));
    const int right = bag.add_topic(recorder::BagTopic::of(
        "/stereo/right/image_raw/compressed", interfaces::message_type<sensor_msgs::msg::CompressedImage>(),
        interfaces::qos::kSensorData));
    for (int i = 0; i < 30; ++i) {
      const std::int64_t stamp = 1000 * kSecond + i * 100 * kMillisecond;
      const auto image = conversions::make_image(stamp, "left", "mono8", 8, 6);
      conversions::pixels(*image).setTo(i);
      add(bag, left, stamp, *image);
      sensor_msgs::msg::CompressedImage compressed;
      compressed.header(image->header());
      compressed.header().stamp().nanosec(image->header().stamp().nanosec() + 2 * kMillisecond);
      compressed.format("png");
      cv::imencode(".png", cv::Mat(6, 8, CV_8U, cv::Scalar(100 + i)), compressed.data());
      add(bag, right, stamp + 2 * kMillisecond, compressed);
    }
    bag.close();
  }
};

TEST_F(ImagesOfABag, AreWrittenUnderOneNameWhereTheyWereTakenAtOnce) {
  record();
  BagImages settings{folder_ / "bag", {}, folder_ / "images", kSecond, 5 * kMillisecond};
  EXPECT_THAT(write_images(settings), ElementsAre(3, 3));
  const auto pairs = find_stereo_images(folder_ / "images");
  ASSERT_THAT(pairs.sets, SizeIs(3));
  EXPECT_EQ(pairs.sets[1].name, "1001000000000");
  for (std::size_t camera = 0; camera < 2; ++camera) {
    const cv::Mat image = cv::imread(pairs.sets[1].files[camera].string(), cv::IMREAD_GRAYSCALE);
    ASSERT_EQ(image.size(), cv::Size(8, 6));
    EXPECT_EQ(image.at<uchar>(2, 3), camera == 0 ? 10 : 110);
  }
}

TEST_F(ImagesOfABag, AreLeftOutWhereNoneWasTakenAtOnce) {
  record();
  BagImages settings{folder_ / "bag",
                     {{"a", "/stereo/left/image_raw"}, {"b", "/stereo/right/image_raw/compressed"}},
                     folder_ / "images",
                     kSecond,
                     kMillisecond};
  EXPECT_THAT(write_images(settings), ElementsAre(3, 0));
}

TEST_F(ImagesOfABag, AreAskedForByTopicsThatAreThere) {
  record();
  const auto refusal = [&](const std::string& arguments) {
    const std::string command =
        "cd '" + folder_.path().string() + "' && " PANVO_CALIBRATION_IMAGES " " + arguments + " > out.txt 2> err.txt";
    const int status = std::system(command.c_str());
    return fmt::format("{}: {}", WEXITSTATUS(status), folder_.read("err.txt"));
  };
  EXPECT_THAT(
      refusal("bag --out images --topics left:=/left"),
      AllOf(HasSubstr("1: "), HasSubstr("bag: contains no images of /left"), HasSubstr("/stereo/left/image_raw")));
  EXPECT_THAT(refusal("bag --out images --topics left"), AllOf(HasSubstr("1: "), HasSubstr("NAME:=TOPIC")));
  EXPECT_THAT(refusal("nowhere --out images"), AllOf(HasSubstr("1: "), HasSubstr("nowhere")));
  EXPECT_THAT(refusal("bag"), HasSubstr("2: "));
  EXPECT_EQ(refusal("bag --out images"), "0: ");
}

}  // namespace
}  // namespace panvo::calibration
