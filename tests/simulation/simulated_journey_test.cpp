// SPDX-License-Identifier: Apache-2.0
// The simulated campus as people use it: from the command line into a data set that the other programs read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "panvo/dataset_player/dataset.hpp"
#include "process.hpp"

namespace panvo::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using ::testing::HasSubstr;

const std::string kShort = CONFIG "/routes/short.yaml";

/// Every file of a folder by its path in there.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = read_file(entry.path());
  }
  return files;
}

class SimulatedJourney : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name) << text;
    return folder_ / name;
  }

  Finished simulate(std::vector<std::string> options) {
    options.insert(options.begin(), PANVO_SIMULATE);
    return run(options, seconds(500));
  }

  /// A rig that renders in no time.
  std::string small_rig() {
    return write("small.yaml", "stereo: {size_px: [80, 60]}\npanorama: {size_px: [128, 64]}\n");
  }

  TemporaryFolder folder_;
};

TEST_F(SimulatedJourney, OfOneSeedIsTheSameByteForByteAndOfAnotherSeedAnotherWorld) {
  const auto rig = small_rig();
  const std::vector<std::pair<std::string, std::string>> runs{{"a", "1"}, {"b", "1"}, {"c", "2"}};
  for (const auto& [out, seed] : runs) {
    const auto finished = simulate({"--route", kShort, "--out", folder_ / out, "--rig", rig, "--seed", seed, "--start",
                                    "9", "--duration", "0.4", "--effects", "movers,rain", "--format", "png"});
    ASSERT_EQ(finished.status, 0) << finished.output;
  }
  const auto first = contents(folder_.path() / "a");
  const auto again = contents(folder_.path() / "b");
  ASSERT_EQ(first.size(), again.size());
  for (const auto& [name, bytes] : first) {
    ASSERT_TRUE(again.contains(name)) << name;
    EXPECT_TRUE(again.at(name) == bytes) << name << " differs";
  }
  const auto image = std::find_if(first.begin(), first.end(), [](const auto& file) {
    return file.first.starts_with("mav0/cam0/data/") && file.first.ends_with(".png");
  });
  ASSERT_NE(image, first.end());
  EXPECT_FALSE(contents(folder_.path() / "c").at(image->first) == image->second) << "two seeds gave the same picture";
}

TEST_F(SimulatedJourney, IsADataSetThatOdometryFollowsToTheCentimetre) {
  const auto out = folder_ / "journey";
  const auto finished = simulate({"--route", kShort, "--out", out, "--start", "6", "--duration", "3"});
  ASSERT_EQ(finished.status, 0) << finished.output;

  const auto dataset = dataset_player::open_dataset(out);
  ASSERT_TRUE(dataset.stereo);
  ASSERT_TRUE(dataset.panorama);
  EXPECT_EQ(dataset.stereo->frames.size(), 76u);  // 25 Hz for 3 s, both ends
  EXPECT_EQ(dataset.panorama->frames.size(), 16u);
  EXPECT_EQ(dataset.ground_truth.size(), 76u);
  EXPECT_NEAR(dataset.stereo->rectified.baseline_m, 0.12, 1e-9);
  EXPECT_THAT(dataset.notes, ::testing::IsEmpty());
  EXPECT_THAT(read_file(fs::path(out) / "sequence.yaml"), HasSubstr("first_heading_diff"));

  const auto played = run(
      {PANVO_RUN, CONFIG "/systems/stereo.yaml", "--dataset", out, "--out", folder_ / "run", "--replay"}, seconds(200));
  ASSERT_EQ(played.status, 0) << played.output;
  const auto evaluated = run({PANVO_EVALUATE, folder_ / "run", out});
  ASSERT_TRUE(evaluated.status == 0 || evaluated.status == 3) << evaluated.output;  // 3: no gnuplot to draw with
  const auto positions = read_file(fs::path(folder_ / "run") / "odometry_binocular.tum");
  EXPECT_EQ(std::count(positions.begin(), positions.end(), '\n'), 76);
  // Exact calibration and an exact truth: a pixel's error in either would be centimetres here.
  const auto report = nlohmann::json::parse(read_file(fs::path(folder_ / "run") / "evaluation.json"));
  EXPECT_LT(report.at("estimates").at(0).at("ate_se3_m").at("rmse").get<double>(), 0.02) << report.dump(1);
}

struct Refusal {
  std::vector<std::string> options;
  std::string named;
};

TEST_F(SimulatedJourney, RefusesWhatCannotBeBeforeAnythingIsRendered) {
  const auto zero_baseline = write("zero.yaml", "stereo: {baseline_m: 0}\n");
  const auto wide_pinhole = write("wide.yaml", "stereo:\n  field_of_view_deg: 200\n");
  const auto broken_route = write("route.yaml", "name: x\njunctions: [gate, nowhere]\n");
  const auto full = folder_ / "full";
  fs::create_directories(full);
  write("full/something", "here");
  const std::vector<Refusal> refusals{
      {{"--route", kShort, "--effects", "snow"}, "there is no effect 'snow'"},
      {{"--route", folder_ / "no.yaml"}, "no.yaml"},
      {{"--route", broken_route}, "nowhere"},
      {{"--junctions", "gate,library"}, "library"},
      {{"--route", kShort, "--rig", zero_baseline}, "zero.yaml:1: stereo.baseline_m"},
      {{"--route", kShort, "--rig", wide_pinhole}, "wide.yaml:2: stereo.field_of_view_deg"},
      {{"--route", kShort, "--start", "10000"}, "nothing to render"},
      {{"--route", kShort, "--assets", folder_ / "none"}, "none"},
      {{"--route", kShort, "--out", full}, "not empty"},
      {{"--route", kShort, "--out", "/proc/panvo/x"}, "cannot be made"},
  };
  for (auto [options, named] : refusals) {
    const auto out = folder_ / "refused";
    if (std::find(options.begin(), options.end(), "--out") == options.end())
      options.insert(options.end(), {"--out", out});
    const auto finished = simulate(options);
    EXPECT_NE(finished.status, 0) << finished.output;
    EXPECT_THAT(finished.output, HasSubstr(named));
    EXPECT_THAT(finished.output, ::testing::Not(HasSubstr("rendered"))) << named;
    EXPECT_FALSE(fs::exists(out)) << named;
  }
}

}  // namespace
}  // namespace panvo::test
