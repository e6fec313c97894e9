// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/camera_group.hpp"

#include <gmock/gmock.h>

#include <map>

#include "panvo/camera_group/camera_component.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::camera_group {
namespace {

using camera_stream::Layout;
using camera_stream::roles_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A device that takes a frame on request.
class TestGrabber final : public Grabber {
 public:
  struct Device {
    std::string name;
    std::vector<DeviceSetting> settings;
  };

  explicit TestGrabber(OnFrame on_frame) : take(std::move(on_frame)) {}

  camera_stream::StreamReport report() const override { return {}; }
  void set(std::vector<DeviceSetting> settings) override { set_to = std::move(settings); }

  const OnFrame take;
  std::vector<DeviceSetting> set_to;
};

std::shared_ptr<sensor_msgs::msg::Image> image(std::uint32_t width, std::uint32_t height) {
  auto image = std::make_shared<sensor_msgs::msg::Image>();
  image->width(width);
  image->height(height);
  image->encoding("mono8");
  image->step(width);
  image->data().resize(std::size_t{width} * height);
  return image;
}

/// A group in a replay container: take() returns after everything was published.
class GroupComponent final : public runtime::Component {
 public:
  explicit GroupComponent(runtime::Context& context) {
    CameraGroup::Description description;
    for (std::size_t i = 0; i < devices; ++i) {
      description.devices.push_back([i](Grabber::OnFrame on_frame) {
        auto grabber = std::make_unique<TestGrabber>(std::move(on_frame));
        grabbers[i] = grabber.get();
        return grabber;
      });
    }
    std::vector<std::string> problems;
    description.images = images_of(roles_of(Layout::kStereo, 2), PANVO_RIGS "/example", problems);
    description.tolerance_ns = 1'000'000;
    group.emplace(context, std::move(description));
    newest = &*group;
  }

  std::optional<CameraGroup> group;

  static inline std::size_t devices = 2;
  static inline std::map<std::size_t, TestGrabber*> grabbers;
  static inline CameraGroup* newest = nullptr;
};

class Cameras : public ::testing::Test {
 protected:
  CameraGroup& load(std::size_t devices) {
    GroupComponent::devices = devices;
    GroupComponent::grabbers.clear();
    harness_.add<GroupComponent>("group");
    return *GroupComponent::newest;
  }
  static void take(std::size_t device, std::int64_t stamp_ns,
                   std::vector<std::shared_ptr<sensor_msgs::msg::Image>> images) {
    GroupComponent::grabbers.at(device)->take({stamp_ns, std::move(images)});
  }

  runtime::ComponentHarness harness_;
  const std::uint32_t width_ = 640, height_ = 480;
};

TEST_F(Cameras, ThatTookImagesTogetherPublishThemUnderOneStamp) {
  const auto& left = harness_.collect(topics::kStereoLeftImageRaw);
  const auto& right = harness_.collect(topics::kStereoRightImageRaw);
  load(2).start();
  take(0, 1'000'000'000, {image(width_, height_)});
  EXPECT_THAT(left, SizeIs(0)) << "the other image is missing";
  take(1, 1'000'500'000, {image(width_, height_)});
  take(0, 1'050'000'000, {image(width_, height_)});  // no partner
  take(0, 1'100'000'000, {image(width_, height_)});
  take(1, 1'100'000'000, {image(width_, height_)});
  ASSERT_THAT(left, SizeIs(2));
  ASSERT_THAT(right, SizeIs(2));
  for (const auto& images : {left, right}) {
    EXPECT_EQ(conversions::stamp_ns(*images[0]), 1'000'000'000);
    EXPECT_EQ(conversions::stamp_ns(*images[1]), 1'100'000'000);
  }
}

TEST_F(Cameras, OfWhichOneTakesBothEyesPublishThemToo) {
  const auto& left = harness_.collect(topics::kStereoLeftImageRaw);
  const auto& right = harness_.collect(topics::kStereoRightImageRaw);
  load(1).start();
  const auto left_eye = image(width_, height_), right_eye = image(width_, height_);
  take(0, 7, {left_eye, right_eye});
  EXPECT_THAT(left, ElementsAre(left_eye)) << "passed on by pointer";
  EXPECT_THAT(right, ElementsAre(right_eye));
}

TEST_F(Cameras, PublishTheirCalibrationsUnlessTheImageIsOfAnotherSize) {
  const auto& infos = harness_.collect(topics::kStereoLeftCameraInfo);
  load(1).start();
  take(0, 7, {image(width_, height_), image(width_, height_)});
  ASSERT_THAT(infos, SizeIs(1));
  EXPECT_EQ(conversions::stamp_ns(*infos[0]), 7);
  EXPECT_EQ(infos[0]->width(), width_);
  const auto& images = harness_.collect(topics::kStereoLeftImageRaw);
  for (const std::int64_t stamp_ns : {8, 9}) take(0, stamp_ns, {image(100, 80), image(100, 80)});
  EXPECT_THAT(infos, SizeIs(1));
  EXPECT_THAT(images, SizeIs(2));
  EXPECT_EQ(std::ranges::count_if(harness_.log(),
                                  [](const auto& line) { return line.find("published without") != std::string::npos; }),
            2)
      << "once for each eye";
}

TEST_F(Cameras, AreSetWhetherTheyAreOpenOrNot) {
  auto& group = load(2);
  group.set({{{"gain", "1"}}, {{"gain", "2"}}});
  group.start();
  const auto& grabbers = GroupComponent::grabbers;
  EXPECT_THAT(grabbers.at(1)->set_to, ElementsAre(DeviceSetting{"gain", "2"}));
  group.set({{{"gain", "3"}}, {}});
  EXPECT_THAT(grabbers.at(0)->set_to, ElementsAre(DeviceSetting{"gain", "3"}));
  EXPECT_THAT(grabbers.at(1)->set_to, SizeIs(0));
}

}  // namespace
}  // namespace panvo::camera_group
