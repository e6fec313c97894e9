// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/found_device.hpp"

#include <gmock/gmock.h>

namespace panvo::camera_stream {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<FoundDevice> kTwo{
    {"aravis_camera",
     "GigEVision",
     "Maker",
     "Cam \"1\"",
     "0815",
     "10.0.0.2",
     {"Mono8", "BayerRG8"},
     "640 x 480 px",
     "1 to 60 Hz",
     ""},
    {"aravis_camera", "USB3Vision", "Maker", "Cam2", "", "1-2", {}, "", "", "is in use by another program"}};

TEST(FoundDevice, IsListedBySerialForPeople) {
  const auto text = to_text(kTwo);
  EXPECT_THAT(text, StartsWith("0815  Maker Cam \"1\"  (GigEVision, 10.0.0.2; driver aravis_camera)\n    formats: "
                               "Mono8, BayerRG8\n    sizes:   640 x 480 px\n    rates:   1 to 60 Hz\n"));
  EXPECT_THAT(
      text,
      HasSubstr("no serial  Maker Cam2  (USB3Vision, 1-2; driver aravis_camera)\n    is in use by another program\n"));
  EXPECT_EQ(to_text({}), "");
}

TEST(FoundDevice, DoesNotSteerTheTerminal) {
  auto forged = kTwo;
  forged.resize(1);
  forged[0].serial = "\x1b[2J1";
  forged[0].model = "Cam\n0816  Maker";
  forged[0].formats = {"Mono8\x07", "\xff"};
  forged[0].problem = "cannot be opened: \x1b]0;title";
  const auto text = to_text(forged);
  EXPECT_THAT(text, StartsWith("\\x1b[2J1  Maker Cam 0816  Maker  ("));
  EXPECT_THAT(text, HasSubstr("formats: Mono8\\x07, \\xff\n"));
  EXPECT_THAT(text, HasSubstr("cannot be opened: \\x1b]0;title\n"));
}

TEST(FoundDevice, IsAnObjectForScripts) {
  EXPECT_THAT(to_json(kTwo), AllOf(HasSubstr(R"("serial": "0815")"), HasSubstr(R"("model": "Cam \"1\"")"),
                                   HasSubstr(R"("BayerRG8")")));
  EXPECT_EQ(to_json({}), "[]\n");
}

}  // namespace
}  // namespace panvo::camera_stream
