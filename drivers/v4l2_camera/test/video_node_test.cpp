// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/video_node.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::v4l2_camera {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A copy of the kernel's sysfs layout on disk.
class NodesInFolders : public ::testing::Test {
 protected:
  NodesInFolders() {
    fs::create_directories(root_ / "class");
    fs::create_directories(root_ / "dev");
  }

  void write(const fs::path& file, const std::string& text) { root_.write(file, text + "\n"); }
  void usb_camera(const std::string& port, const std::string& serial, const std::string& product) {
    const fs::path device = fs::path("usb") / port;
    if (!serial.empty()) write(device / "serial", serial);
    write(device / "manufacturer", "Maker");
    write(device / (port + ":1.0") / "bInterfaceNumber", "00");
    write(device / "product", product);
  }
  void node(const std::string& node, const std::string& name, int index, const std::string& port = "") {
    write(fs::path("class") / node / "name", name);
    write(fs::path("class") / node / "index", std::to_string(index));
    write(fs::path("dev") / node, "");
    if (!port.empty()) fs::create_symlink(root_ / "usb" / port / (port + ":1.0"), root_ / "class" / node / "device");
  }
  std::vector<VideoNode> list() const { return list_nodes(root_ / "class", root_ / "dev"); }
  std::string dev(const std::string& name) const { return (root_ / "dev" / name).string(); }

  const panvo::test::TemporaryFolder root_;
};

TEST_F(NodesInFolders, TellSerialNumberNameMakerAndPort) {
  usb_camera("1-2.3", "ABC123", "Stereo");
  node("video10", "Stereo: Stereo", 0, "1-2.3");
  node("video2", "vivid-000-vid-cap", 0);
  node("v4l-subdev0", "sensor", 0);
  const auto nodes = list();
  ASSERT_THAT(nodes, SizeIs(2));
  EXPECT_EQ(nodes[0].path, dev("video2")) << "by number";
  EXPECT_EQ(nodes[0].serial, "");
  EXPECT_EQ(nodes[1].path, dev("video10"));
  EXPECT_EQ(nodes[1].serial, "ABC123");
  EXPECT_EQ(nodes[1].vendor, "Maker");
  EXPECT_EQ(nodes[1].port, "1-2.3");
  EXPECT_EQ(nodes[1].name, "Stereo: Stereo");
  EXPECT_THAT(list_nodes(root_ / "nowhere", root_ / "dev"), SizeIs(0));
}

TEST_F(NodesInFolders, AreMeantBySerialPathLinkPortOrName) {
  usb_camera("1-1", "LEFT", "Cam");
  usb_camera("1-2", "RIGHT", "Cam");
  node("video0", "Cam", 0, "1-1");
  node("video1", "Cam", 1, "1-1");  // metadata
  node("video2", "Cam", 0, "1-2");
  node("video3", "Other", 0);
  fs::create_symlink(root_ / "dev" / "video2", root_ / "dev" / "by-id");
  const auto path_of = [&](const std::string& selector) {
    const auto found = find_node(list(), selector);
    return found.node ? found.node->path : found.problem;
  };
  EXPECT_EQ(path_of(""), dev("video0"));
  EXPECT_EQ(path_of("RIGHT"), dev("video2"));
  EXPECT_EQ(path_of(dev("video2")), dev("video2"));
  EXPECT_EQ(path_of(dev("by-id")), dev("video2"));
  EXPECT_EQ(path_of("1-1"), dev("video0"));
  EXPECT_EQ(path_of("Other"), dev("video3"));
  EXPECT_THAT(path_of("Cam"), AllOf(HasSubstr("'Cam' matches 2 cameras"), HasSubstr("USB port 1-2")));
  EXPECT_THAT(path_of("MIDDLE"), AllOf(HasSubstr("camera 'MIDDLE' not found"), HasSubstr("LEFT (Cam at")));
}

TEST(FindingANode, SaysThatThereIsNone) {
  EXPECT_THAT(find_node({}, "").problem, HasSubstr("no camera is connected"));
  EXPECT_THAT(find_node({}, "X").problem, HasSubstr("camera 'X' not found; no camera is connected"));
}

TEST(FindingACameraAgain, GoesByItsSerialNumberWhereverItIsPluggedIn) {
  const VideoNode known{"/dev/video0", "Cam", "S1", "M", "1-1", 0};
  const VideoNode elsewhere{"/dev/video4", "Cam", "S1", "M", "1-3", 0},
      metadata{"/dev/video5", "Cam", "S1", "M", "1-3", 1};
  const VideoNode another{"/dev/video0", "Cam", "S2", "M", "1-1", 0};
  EXPECT_EQ(find_again({another, metadata, elsewhere}, known).node->path, "/dev/video4");
  const auto none = find_again({another}, known);
  EXPECT_FALSE(none.node) << "another camera at the same port is not taken for it";
  EXPECT_THAT(none.problem, AllOf(HasSubstr("Cam S1 is no longer connected"), HasSubstr("S2 (Cam at /dev/video0")));
}

TEST(FindingACameraAgain, GoesByItsPortWhereSerialNumbersDoNotTellThemApart) {
  const VideoNode first{"/dev/video0", "Cam", "0001", "M", "1-1", 0},
      second{"/dev/video2", "Cam", "0001", "M", "1-2", 0};
  EXPECT_EQ(find_again({first, second}, second).node->path, "/dev/video2");
  const VideoNode nameless{"/dev/video0", "Cam", "", "M", "1-1", 0};
  VideoNode moved = nameless;
  moved.path = "/dev/video7";
  EXPECT_EQ(find_again({moved}, nameless).node->path, "/dev/video7");
  moved.port = "1-2";
  EXPECT_FALSE(find_again({moved}, nameless).node);
  const VideoNode no_usb{"/dev/video0", "vivid", "", "", "", 0};
  EXPECT_TRUE(find_again({no_usb}, no_usb).node);
}

}  // namespace
}  // namespace panvo::v4l2_camera
