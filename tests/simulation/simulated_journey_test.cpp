// SPDX-License-Identifier: Apache-2.0
// The simulated campus from the command line, rendered into a data set that the other programs read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"

namespace panvo::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using ::testing::HasSubstr;

const std::string kShort = CONFIG "/routes/short.yaml";

/// Contents of all files of a folder, by relative path.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = read_file(entry.path());
  }
  return files;
}

class SimulatedJourney : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) { return folder_.write(name, text); }

  Finished simulate(std::vector<std::string> options) {
    options.insert(options.begin(), PANVO_SIMULATE);
    return run(options, seconds(500));
  }

  /// A rig with small images, for fast rendering.
  std::string small_rig() {
    return write("small.yaml", "stereo: {size_px: [80, 60]}\npanorama: {size_px: [128, 64]}\n");
  }

  TemporaryFolder folder_;
};

TEST_F(SimulatedJourney, OfOneSeedIsTheSameByteForByteEvenWhereItWasKilledAndOfAnotherSeedAnotherWorld) {
  const auto rig = small_rig();
  const auto words = [&](const std::string& out, const std::string& seed) {
    return std::vector<std::string>{
        "--route",  kShort,    "--out", folder_ / out, "--rig", rig,         "--seed",
        seed,       "--start", "9",     "--duration",  "3",     "--effects", "movers,rain,sudden_light",
        "--format", "png"};
  };
  const auto whole = simulate(words("whole", "1"));
  ASSERT_EQ(whole.status, 0) << whole.output;
  const auto first = contents(folder_ / "whole");

  auto to_be_killed = words("killed", "1");
  to_be_killed.insert(to_be_killed.begin(), PANVO_SIMULATE);
  {
    Process process(to_be_killed);
    const fs::path journal = folder_ / "killed.partial/rendered.csv";
    ASSERT_TRUE(eventually([&] { return fs::exists(journal) && fs::file_size(journal) > 500; }, seconds(300)))
        << process.output();
    process.signal(SIGKILL);
    ASSERT_EQ(process.wait(), 128 + SIGKILL) << process.output();
  }
  EXPECT_FALSE(fs::exists(folder_ / "killed")) << "an incomplete data set must not look complete";

  const auto other = simulate(words("killed", "2"));
  EXPECT_NE(other.status, 0) << "a data set must not mix two worlds";
  EXPECT_THAT(other.output, HasSubstr("'seed: 1' there, 'seed: 2' requested"));

  const auto resumed = simulate(words("killed", "1"));
  ASSERT_EQ(resumed.status, 0) << resumed.output;
  EXPECT_THAT(resumed.output, HasSubstr("of 76 instants: resuming"));
  const auto again = contents(folder_ / "killed");
  ASSERT_EQ(first.size(), again.size());
  for (const auto& [name, bytes] : first) {
    ASSERT_TRUE(again.contains(name)) << name;
    EXPECT_TRUE(again.at(name) == bytes) << name << " differs";
  }

  const auto another = simulate(words("another", "2"));
  ASSERT_EQ(another.status, 0) << another.output;
  const auto image = std::find_if(first.begin(), first.end(), [](const auto& file) {
    return file.first.starts_with("mav0/cam0/data/") && file.first.ends_with(".png");
  });
  ASSERT_NE(image, first.end());
  EXPECT_FALSE(contents(folder_ / "another").at(image->first) == image->second) << "two seeds gave the same image";
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
  EXPECT_THAT(read_file(out / "sequence.yaml"), HasSubstr("first_heading_diff"));

  const auto played = run(
      {PANVO_RUN, CONFIG "/systems/stereo.yaml", "--dataset", out, "--out", folder_ / "run", "--replay"}, seconds(200));
  ASSERT_EQ(played.status, 0) << played.output;
  const auto evaluated = run({PANVO_EVALUATE, folder_ / "run", out});
  ASSERT_TRUE(evaluated.status == 0 || evaluated.status == 3) << evaluated.output;  // 3: gnuplot is missing
  const auto positions = read_file(folder_ / "run" / "odometry_binocular.tum");
  EXPECT_EQ(std::count(positions.begin(), positions.end(), '\n'), 76);
  // Calibration and ground truth are exact: an error of one pixel in either would cause centimetres here.
  const auto report = nlohmann::json::parse(read_file(folder_ / "run" / "evaluation.json"));
  EXPECT_LT(report.at("estimates").at(0).at("ate_se3_m").at("rmse").get<double>(), 0.02) << report.dump(1);
}

TEST_F(SimulatedJourney, InPartListsWhatIsTrueOfThatPart) {
  // The route passes its junction twice, the second time in its last third.
  constexpr std::int64_t kFrom_s = 30, kFor_s = 20;
  constexpr std::int64_t kFrom_ns = (1'700'000'000 + kFrom_s) * 1'000'000'000,
                         kTo_ns = kFrom_ns + kFor_s * 1'000'000'000;
  const auto finished = simulate({"--route", kShort, "--effects", "all", "--truth-only", "--out", folder_ / "part",
                                  "--start", std::to_string(kFrom_s), "--duration", std::to_string(kFor_s)});
  ASSERT_EQ(finished.status, 0) << finished.output;
  const auto sequence = YAML::LoadFile(folder_ / "part/sequence.yaml");
  EXPECT_EQ(sequence["panorama_clock_offset_ns"].as<std::int64_t>(), 20'000'000);
  ASSERT_EQ(sequence["visits"].size(), 1u);
  EXPECT_GE(sequence["visits"][0]["t_ns"].as<std::int64_t>(), kFrom_ns);
  EXPECT_LE(sequence["visits"][0]["t_ns"].as<std::int64_t>(), kTo_ns);
  EXPECT_EQ(sequence["revisits"].size(), 0u) << "the first visit is outside this part";
  ASSERT_GT(sequence["movers"].size(), 0u);
  for (const auto* list : {"movers", "illumination_events"}) {
    for (const auto& event : sequence[list]) {
      EXPECT_GE(event["from_ns"].as<std::int64_t>(), kFrom_ns) << list;
      EXPECT_LE(event["from_ns"].as<std::int64_t>(), event["to_ns"].as<std::int64_t>()) << list;
      EXPECT_LE(event["to_ns"].as<std::int64_t>(), kTo_ns) << list;
    }
  }
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
      {{"--route", kShort, "--effects", "snow"}, "unknown effect 'snow'"},
      {{"--route", folder_ / "no.yaml"}, "no.yaml"},
      {{"--route", broken_route}, "nowhere"},
      {{"--junctions", "gate,library"}, "library"},
      {{"--route", kShort, "--rig", zero_baseline}, "zero.yaml:1: stereo.baseline_m"},
      {{"--route", kShort, "--rig", wide_pinhole}, "wide.yaml:2: stereo.field_of_view_deg"},
      {{"--route", kShort, "--start", "10000"}, "nothing to render"},
      {{"--route", kShort, "--assets", folder_ / "none"}, "none"},
      {{"--route", kShort, "--out", full}, "not empty"},
      {{"--route", kShort, "--out", "/proc/panvo/x"}, "cannot be created"},
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

TEST_F(SimulatedJourney, OfOptionsThatContradictEachOtherIsWrongUsage) {
  const std::vector<Refusal> refusals{
      {{"--night", "--hour", "7"}, "--night"},
      {{"--wet", "--season", "snow"}, "season 'snow' contradicts wet"},
      {{"--layout", "row"}, "--layout"},
      {{"--layout", "hall", "--night"}, "layout 'hall' contradicts night"},
      {{"--layout", "hall", "--hilliness", "1"}, "layout 'hall' contradicts hilliness"},
  };
  for (auto [options, named] : refusals) {
    options.insert(options.end(), {"--route", kShort, "--out", folder_ / "refused"});
    const auto finished = simulate(options);
    EXPECT_EQ(finished.status, 2) << finished.output;
    EXPECT_THAT(finished.output, HasSubstr(named));
  }
}

}  // namespace
}  // namespace panvo::test
