// SPDX-License-Identifier: Apache-2.0
/// Tests the command line of panvo_places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "made_up_view.hpp"
#include "painted_place.hpp"
#include "panvo/places/image_folder.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::places {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

struct Finished {
  int status = -1;
  std::string output;
};

Finished run(const std::string& arguments, const char* errors = "2>&1") {
  Finished finished;
  std::FILE* pipe = ::popen((std::string(PANVO_PLACES) + " " + arguments + " " + errors).c_str(), "r");
  char part[4096];
  while (std::fgets(part, sizeof part, pipe)) finished.output += part;
  finished.status = WEXITSTATUS(::pclose(pipe));
  return finished;
}

class PlacesCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(known_);
    fs::create_directories(seen_);
    for (std::uint64_t i = 1; i <= 3; ++i) {
      cv::imwrite((known_ / ("hall" + std::to_string(i) + ".jpg")).string(), test::paint_place(i));
    }
    cv::imwrite((seen_ / "1.png").string(),
                test::render(test::paint_place(2), test::moved(60.0, 0.0, 0.0, 0.0).linear()));
    cv::imwrite((seen_ / "2.png").string(), test::paint_place(9));
  }
  /// Adds an image of which half is missing.
  void add_cut_off(const fs::path& file) {
    cv::imwrite(file.string(), test::paint_place(1));
    fs::resize_file(file, fs::file_size(file) / 2);
  }
  Finished build(const std::string& more = "") {
    return run("build " + known_.string() + " --out " + library_ + " " + more);
  }

  panvo::test::TemporaryFolder folder_;
  fs::path known_ = folder_ / "known", seen_ = folder_ / "seen";
  std::string library_ = (folder_ / "campus.places").string();
};

TEST_F(PlacesCommand, FindsAPlaceAndSaysThatAnotherIsUnknown) {
  const auto built = build();
  EXPECT_EQ(built.status, 0) << built.output;
  EXPECT_THAT(built.output, HasSubstr("3 places, 0 images skipped; 0 places give positions in metres"));
  const auto matched = run("match " + seen_.string() + " --library " + library_);
  EXPECT_EQ(matched.status, 0);
  EXPECT_THAT(matched.output, HasSubstr("no metres"));
  EXPECT_THAT(matched.output, HasSubstr("1.png: hall2.jpg, heading +"));
  EXPECT_THAT(matched.output, HasSubstr("2.png: unknown ("));
  EXPECT_THAT(matched.output, HasSubstr("2 images: 1 found, 1 unknown, 0 skipped"));
}

TEST_F(PlacesCommand, SkipsABadImageAndNamesIt) {
  add_cut_off(known_ / "hall9.jpg");
  const auto built = build();
  EXPECT_EQ(built.status, 1);
  EXPECT_THAT(built.output, HasSubstr("hall9.jpg: skipped: is a JPEG that was cut off"));
  EXPECT_THAT(built.output, HasSubstr("3 places, 1 images skipped"));
  add_cut_off(seen_ / "3.jpg");
  const auto matched = run("match " + seen_.string() + " --library " + library_);
  EXPECT_EQ(matched.status, 1);
  EXPECT_THAT(matched.output, HasSubstr("3.jpg: skipped: is a JPEG that was cut off"));
  EXPECT_THAT(matched.output, HasSubstr("1 found, 1 unknown, 1 skipped"));
}

TEST_F(PlacesCommand, WritesTablesAndPictures) {
  std::FILE* poses = std::fopen((known_ / "poses.csv").c_str(), "w");
  std::fputs("image,x_m,y_m,heading_deg\nhall2.jpg,7.5,-2,90\n", poses);
  std::fclose(poses);
  ASSERT_EQ(build().status, 0);
  const auto out = folder_ / "out";
  const auto matched = run("match " + seen_.string() + " --library " + library_ + " --json --out " + out.string(), "");
  ASSERT_EQ(matched.status, 0);
  const auto report = nlohmann::json::parse(matched.output);
  const auto& first = report["images"][0];
  EXPECT_EQ(first["state"], "found");
  EXPECT_EQ(first["place"], "hall2.jpg");
  EXPECT_NEAR(first["heading_deg"].get<double>(), 60.0, 0.5);
  EXPECT_EQ(first["place_position_m"][0], 7.5);
  EXPECT_FALSE(first.contains("position_m")) << "one pose gives no metres";
  EXPECT_EQ(report["images"][1]["state"], "unknown");
  EXPECT_TRUE(fs::exists(out / "places.csv"));
  const auto picture = cv::imread((out / "match_0000.jpg").string());
  EXPECT_EQ(picture.size(), cv::Size(540, 558));
  // turned to one heading, the halves are alike
  cv::Mat difference;
  cv::absdiff(picture.rowRange(18 + 60, 18 + 200), picture.rowRange(288 + 60, 288 + 200), difference);
  EXPECT_LT(cv::mean(difference)[0], 25.0);
}

TEST_F(PlacesCommand, WritesUtf8WhateverTheImagesAreCalled) {
  ASSERT_EQ(build().status, 0);
  fs::rename(seen_ / "1.png", seen_ / "caf\xe9.png");  // Latin-1
  const auto matched = run("match " + seen_.string() + " --library " + library_ + " --json", "");
  EXPECT_EQ(matched.status, 0);
  EXPECT_THAT(nlohmann::json::parse(matched.output).dump(), HasSubstr("caf\xef\xbf\xbd.png"));
}

TEST_F(PlacesCommand, RefusesWhatItCannotUse) {
  EXPECT_EQ(run("").status, 2);
  EXPECT_EQ(run("build /absent --out " + library_).status, 2);
  EXPECT_THAT(run("build " + (folder_ / "").string() + " --out " + library_).output, HasSubstr("holds no images"));
  EXPECT_EQ(run("match " + seen_.string() + " --library /absent").status, 2);
  ASSERT_EQ(build().status, 0);
  EXPECT_THAT(build("--top 30").output, HasSubstr("belong together"));
  std::FILE* poses = std::fopen((known_ / "poses.txt").c_str(), "w");
  std::fputs("0 0 0 0 0 0 0 1\n", poses);
  std::fclose(poses);
  EXPECT_THAT(build().output, HasSubstr("1 poses for 3 images"));
  EXPECT_EQ(run("--help").status, 0);
}

/// Two images of names with a space, and a file of poses.
class PosesOfImages : public testing::Test {
 protected:
  static constexpr const char* kMark = "\xEF\xBB\xBF";

  std::vector<FolderImage> read(const std::string& poses) {
    for (const char* name : {"IMG 0001.jpg", "IMG 0002.jpg"}) folder_.write(name, "");
    return read_image_folder(folder_.path(), folder_.write("poses", poses));
  }
  std::string error_of(const std::string& poses) {
    try {
      read(poses);
    } catch (const FolderError& error) {
      return error.what();
    }
    return "";
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(PosesOfImages, MayBeginWithTheMarkOfUtf8) {
  const auto images = read(std::string(kMark) + "0.5 1 2 3 0 0 0 1\n1.5 4 5 6 0 0 0 1\n");
  ASSERT_EQ(images.size(), 2U);
  ASSERT_TRUE(images[0].map_from_base && images[1].map_from_base);
  EXPECT_EQ(images[0].time_s, 0.5);
  EXPECT_EQ(images[0].map_from_base->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(read(std::string(kMark) + "IMG 0001.jpg,1,2,90\n").at(0).map_from_base);
}

TEST_F(PosesOfImages, MayBeginWithNamesOfColumns) {
  for (const char* header : {"timestamp tx ty tz qx qy qz qw\n", "timestamp,tx,ty,tz,qx,qy,qz,qw\r\n"}) {
    const auto images = read(std::string(header) + "0.5 1 2 3 0 0 0 1\n1.5 4 5 6 0 0 0 1\n");
    ASSERT_TRUE(images[0].map_from_base && images[1].map_from_base);
    EXPECT_EQ(images[1].map_from_base->translation(), Eigen::Vector3d(4, 5, 6));
  }
  EXPECT_THAT(error_of("timestamp tx ty tz qx qy qz qw\n0.5 1 2 3 0 0 0 1\n"), HasSubstr("1 poses for 2 images"));
}

TEST_F(PosesOfImages, MayBeOfNamesWithSpaces) {
  const auto images = read("image, x, y, heading\r\n IMG 0002.jpg , 1, 2, 90\r\n,,,\r\nIMG 0003.jpg,5,5,0\r\n");
  ASSERT_TRUE(images[1].map_from_base);
  EXPECT_FALSE(images[0].map_from_base);
  EXPECT_EQ(images[1].map_from_base->translation(), Eigen::Vector3d(1, 2, 0));
}

TEST_F(PosesOfImages, AreRefusedIfTheyNameNoneOfThem) {
  const std::string expected = (folder_ / "poses").string() + ": names none of the images; poses are lines image,x_m";
  EXPECT_THAT(error_of("image,x_m,y_m,heading_deg\nDSC1.jpg,1,2,90\nDSC2.jpg,1,2,90\n"), HasSubstr(expected));
  EXPECT_THAT(error_of("image,x_m,y_m,heading_deg\n"), HasSubstr(expected));
  EXPECT_THAT(error_of("IMG 0001.jpg 1 2 90\nIMG 0002.jpg 1 2 90\n"), HasSubstr(expected)) << "without commas";
}

}  // namespace
}  // namespace panvo::places
