// SPDX-License-Identifier: Apache-2.0
// A USB stereo camera shows the rendered walk in /exchange/walk, both views in one JPEG image; the output of the driver
// is recorded into a bag.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "usb_camera.hpp"

namespace panvo::test {
namespace {

namespace fs = std::filesystem;

std::vector<Bytes> side_by_side(const fs::path& walk) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(walk / "image_0")) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  std::vector<Bytes> files;
  for (const auto& name : names) {
    cv::Mat whole;
    cv::hconcat(cv::imread((walk / "image_0" / name).string()), cv::imread((walk / "image_1" / name).string()), whole);
    cv::imencode(".jpg", whole, files.emplace_back(), {cv::IMWRITE_JPEG_QUALITY, 95});
  }
  return files;
}

TEST(Walk, IsRecordedThroughAUsbStereoCamera) {
  const auto pictures = side_by_side("/exchange/walk");
  ASSERT_FALSE(pictures.empty());
  constexpr std::uint32_t kBefore = 5, kAfter = 3;  // number of frames that show the first and the last image
  std::atomic<std::uint32_t> begin = std::numeric_limits<std::uint32_t>::max();  // the frame of the first step
  UsbCamera camera(0, {.serial = "SBS001", .width = 640, .height = 240, .rate_hz = 10}, [&](std::uint32_t number) {
    return pictures.at(std::min<std::size_t>(number - std::min(number, begin.load()), pictures.size() - 1));
  });
  const TemporaryFolder folder;
  const std::string bag = folder / "bag";
  Process panvo({PANVO_RUN, CAMERA_TO_BAG, "rig:=/exchange", "bag:=" + bag});
  ASSERT_TRUE(eventually([&] { return fs::exists(bag) && camera.sent() > 0; })) << panvo.output();
  begin = camera.sent() + kBefore;
  EXPECT_TRUE(eventually([&] { return camera.sent() >= begin + pictures.size() + kAfter; })) << panvo.output();
  panvo.signal(SIGINT);
  EXPECT_EQ(panvo.wait(std::chrono::seconds(20)), 0) << panvo.output();
  fs::copy(bag, "/exchange/bag", fs::copy_options::recursive);
}

}  // namespace
}  // namespace panvo::test
