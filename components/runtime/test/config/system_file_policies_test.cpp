// SPDX-License-Identifier: Apache-2.0
// Process settings in system files: restarts, limits, access.
#include <spdlog/fmt/fmt.h>

#include "system_file_fixture.hpp"

namespace panvo::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A container with `line` and a component with `more`.
std::string with_line(const std::string& line, const std::string& more = "") {
  return fmt::format(
      "launch:\n- node_container:\n    name: x\n{}    composable_node:\n    - {{pkg: panvo_a, plugin: A, name: a{}}}\n",
      line.empty() ? "" : "    " + line + "\n", more);
}

TEST_F(SystemFile, SaysWhichProcessesAreStartedAgainAndHowSoon) {
  const auto system = read_system_file(folder_.write("respawn.yaml", R"(launch:
- node_container:
    name: cameras
    respawn: true
    respawn_delay: 0.5
    composable_node: [{pkg: panvo_a, plugin: A, name: a}]
- node_container:
    name: results
    respawn: "true"
    composable_node: [{pkg: panvo_a, plugin: A, name: b}]
- node_container:
    name: once
    composable_node: [{pkg: panvo_a, plugin: A, name: c}]
)"));
  EXPECT_TRUE(system.containers[0].respawn);
  EXPECT_EQ(system.containers[0].respawn_delay_s, 0.5);
  EXPECT_TRUE(system.containers[1].respawn);
  EXPECT_EQ(system.containers[1].respawn_delay_s, std::nullopt);
  EXPECT_FALSE(system.containers[2].respawn);
  EXPECT_THAT(system.notes, IsEmpty());
  for (const char* delay : {"soon", "-1", "1s", "nan", "1e9"}) {
    const auto file = fmt::format(
        "launch:\n- node_container:\n    name: x\n    respawn_delay: {}\n    composable_node: [{{pkg: panvo_a, plugin: "
        "A, name: a}}]\n",
        delay);
    EXPECT_THAT(problems(file),
                ElementsAre(fmt::format("stereo.yaml:4: respawn_delay is \"{}\"; write seconds, 0 to 3600", delay)));
  }
}

TEST_F(SystemFile, SaysHowMuchAProcessTakesFromOthers) {
  const auto file = [](const std::string& line) {
    return fmt::format(
        "launch:\n- node_container:\n    name: x\n{}    composable_node: [{{pkg: panvo_a, plugin: A, name: a}}]\n",
        line);
  };
  const auto unsaid = read_system_file(folder_.write("unsaid.yaml", file(""))).containers[0];
  EXPECT_EQ(unsaid.max_message_mb, 64);
  EXPECT_EQ(unsaid.max_topic_rate_hz, 1000);
  const auto said =
      read_system_file(folder_.write("said.yaml", file("    max_message_mb: 2.5\n    max_topic_rate_hz: 50\n")))
          .containers[0];
  EXPECT_EQ(said.max_message_mb, 2.5);
  EXPECT_EQ(said.max_topic_rate_hz, 50);
  EXPECT_THAT(problems(file("    max_message_mb: 2001\n")),
              ElementsAre("stereo.yaml:4: max_message_mb is \"2001\"; write megabytes, 0 to 2000"));
  EXPECT_THAT(problems(file("    max_topic_rate_hz: fast\n")),
              ElementsAre("stereo.yaml:4: max_topic_rate_hz is \"fast\"; write messages per second, 0 to 1000000"));
}

TEST_F(SystemFile, SaysUpToWhichSizeProcessesShareImages) {
  const auto file = [](const std::string& line) {
    return fmt::format(
        "launch:\n- node_container:\n    name: x\n{}    composable_node: [{{pkg: panvo_a, plugin: A, name: a}}]\n",
        line);
  };
  EXPECT_EQ(read_system_file(folder_.write("unsaid.yaml", file(""))).containers[0].shared_images_mb, 64);
  const auto shared = folder_.write("shared.yaml", file("    shared_images_mb: 1.75\n"));
  EXPECT_EQ(read_system_file(shared).containers[0].shared_images_mb, 1.75);
  for (const char* size : {"yes", "-1", "2 MB", "65"}) {
    EXPECT_THAT(
        problems(file(fmt::format("    shared_images_mb: {}\n", size))),
        ElementsAre(fmt::format("stereo.yaml:4: shared_images_mb is \"{}\"; write megabytes, 0 (off) to 64", size)));
  }
}

TEST_F(SystemFile, SaysWhoMaySteerByService) {
  const auto access = [&](const std::string& line) {
    return read_system_file(folder_.write("services.yaml", with_line(line))).containers[0].services;
  };
  EXPECT_EQ(access(""), ServiceAccess::kByHost);
  EXPECT_EQ(access("services: look"), ServiceAccess::kLook);
  EXPECT_EQ(access("services: steer"), ServiceAccess::kSteer);
  EXPECT_EQ(access("services: off"), ServiceAccess::kOff);
  EXPECT_THAT(problems(with_line("services: stear")),
              ElementsAre("stereo.yaml:4: services is \"stear\"; did you mean \"steer\"?"));
  EXPECT_THAT(problems(with_line("services: nobody")),
              ElementsAre("stereo.yaml:4: services is \"nobody\"; known names: look, steer, off"));
}

TEST_F(SystemFile, SaysWhatBecomesOfComponentsThatFailAndOfTheOthers) {
  const auto read = [&](const std::string& line, const std::string& more) {
    return read_system_file(folder_.write("on_error.yaml", with_line(line, more))).containers[0];
  };
  EXPECT_EQ(read("", "").components[0].on_error, OnError::kRestart);
  EXPECT_EQ(read("on_error: stop", "").components[0].on_error, OnError::kStop);
  EXPECT_EQ(read("on_error: stop", ", on_error: ignore").components[0].on_error, OnError::kIgnore);
  EXPECT_THAT(problems(with_line("on_error: restrat")),
              ElementsAre("stereo.yaml:4: on_error is \"restrat\"; did you mean \"restart\"?"));
  EXPECT_TRUE(read("", "").required);
  EXPECT_FALSE(read("required: false", "").required);
}

TEST_F(SystemFile, SaysWhereRequestsMayNameFilesAndHowManyAreAnswered) {
  const auto file = folder_.write("below.yaml", with_line("files_below: ."));
  EXPECT_TRUE(std::filesystem::equivalent(read_system_file(file).containers[0].files_below, folder_.path()));
  EXPECT_THAT(problems(with_line("files_below: nowhere")), ElementsAre(HasSubstr("folder \"nowhere\" does not exist")));
  const auto limited = folder_.write("limited.yaml", with_line("requests_per_s: 5"));
  EXPECT_EQ(read_system_file(limited).containers[0].requests_per_s, 5);
  EXPECT_THAT(problems(with_line("requests_per_s: -1")),
              ElementsAre("stereo.yaml:4: requests_per_s is \"-1\"; write requests per second, 0 to 100000"));
}

}  // namespace
}  // namespace panvo::runtime
