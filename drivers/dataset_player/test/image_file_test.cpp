// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/image_file.hpp"

#include <gmock/gmock.h>

#include "written_dataset.hpp"

namespace panvo::dataset_player {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ImageFiles = testing::WrittenDataset;

TEST_F(ImageFiles, AreDecodedAsTheyAreOrGrey) {
  write_image("a.jpg", kWidth, kHeight, 3);
  cv::Mat image;
  ImageDecoder decoder;
  EXPECT_EQ(decoder.decode(root_ / "a.jpg", Colour::kAsStored, image), std::nullopt);
  EXPECT_EQ(image.type(), CV_8UC3);
  EXPECT_EQ(decoder.decode(root_ / "a.jpg", Colour::kGrey, image), std::nullopt);
  EXPECT_EQ(image.type(), CV_8UC1);
}

TEST_F(ImageFiles, ThatCannotBeDecodedAreNamed) {
  write("text.png", "no image");
  write("empty.png", "");
  cv::Mat image(kHeight, kWidth, CV_8UC1);  // of the previous frame: must not be returned
  ImageDecoder decoder;
  EXPECT_THAT(*decoder.decode(root_ / "text.png", Colour::kAsStored, image),
              AllOf(HasSubstr("text.png"), HasSubstr("cannot be decoded")));
  EXPECT_TRUE(image.empty());
  EXPECT_THAT(*decoder.decode(root_ / "empty.png", Colour::kAsStored, image), HasSubstr("is empty"));
  EXPECT_THAT(*decoder.decode(root_ / "nowhere.png", Colour::kAsStored, image), HasSubstr("cannot be read"));
  EXPECT_TRUE(image.empty());
}

TEST_F(ImageFiles, ThatWereCutOffAreRefused) {
  for (const char* name : {"a.jpg", "a.png"}) {
    write_image(name, 640, 480);
    fs::resize_file(root_ / name, fs::file_size(root_ / name) * 2 / 3);
    cv::Mat image;
    EXPECT_NE(ImageDecoder().decode(root_ / name, Colour::kAsStored, image), std::nullopt) << name;
    EXPECT_TRUE(image.empty()) << name;
  }
}

TEST_F(ImageFiles, AreListedByNumberThenName) {
  for (const char* name : {"left10.jpg", "left9.JPG", "left1.png"}) write(name, "");
  write("notes.txt", "");
  const auto images = list_images(root_);
  ASSERT_EQ(images.size(), 3u);
  EXPECT_EQ(images[0].path.filename(), "left1.png");
  EXPECT_EQ(images[1].number, 9u);
  EXPECT_EQ(images[2].path.filename(), "left10.jpg");
}

}  // namespace
}  // namespace panvo::dataset_player
