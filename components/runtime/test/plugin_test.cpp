// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::runtime {
namespace {

using testing::HasSubstr;

bool is_mapped(const std::string& library) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find(library) != std::string::npos) return true;
  }
  return false;
}

sensor_msgs::msg::Image image() {
  sensor_msgs::msg::Image image;
  image.encoding("mono8");
  image.width(1);
  image.height(1);
  image.step(1);
  image.data().resize(1);
  return image;
}

ComponentDescription relay() {
  ComponentDescription description;
  description.package = "panvo_test_relay";
  description.plugin = "RelayComponent";
  description.name = "relay";
  description.name_space = "/";
  return description;
}

std::string why_not(const ComponentDescription& description) {
  Container container({.replay = true});
  try {
    container.load(description);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "loaded";
}

TEST(Plugin, LoadsAndUnloadsTwoHundredTimesInARunningContainer) {
  Container container({.replay = false});
  container.start();
  for (int i = 0; i < 200; ++i) {
    container.load(relay());
    ASSERT_TRUE(is_mapped("panvo_test_relay"));
    ASSERT_TRUE(container.unload("relay"));
    ASSERT_FALSE(is_mapped("panvo_test_relay")) << "cycle " << i;
  }
}

TEST(Plugin, StaysMappedAsLongAsAMessageOfItsMakingIsHeld) {
  ComponentHarness harness;
  harness.load("panvo_test_relay", "panvo::RelayComponent");  // ROS 2 plugin names include the namespace
  std::shared_ptr<const sensor_msgs::msg::Image> held;
  {
    struct Keeper : Component {
      Keeper(Context& context, std::shared_ptr<const sensor_msgs::msg::Image>& keep) {
        context.input(topics::kStereoLeftImageRect,
                      [&keep](std::shared_ptr<const sensor_msgs::msg::Image> image) { keep = std::move(image); });
      }
    };
    ComponentDescription keeper = relay();
    keeper.name = "keeper";
    harness.container().add(keeper, [&](Context& context) { return std::make_unique<Keeper>(context, held); });
  }
  harness.publish(topics::kStereoLeftImageRaw, image());
  ASSERT_TRUE(held);
  ASSERT_TRUE(harness.container().unload("test_relay"));
  EXPECT_TRUE(is_mapped("panvo_test_relay"));
  held.reset();
  EXPECT_FALSE(is_mapped("panvo_test_relay"));
}

TEST(Plugin, LeavesTheTypesOfItsMessagesBehind) {
  ComponentHarness harness;
  harness.load("panvo_test_relay", "CountComponent");
  ASSERT_TRUE(harness.container().unload("test_relay"));
  ASSERT_FALSE(is_mapped("panvo_test_relay"));
  EXPECT_TRUE(is_mapped("libstd_msgs__panvo"));
  // The topic has the type that the plugin knew: it reads the bytes of somebody who does not know it.
  SamplePtr seen;
  harness.container().observe([](const TopicDescription& topic) { return topic.name == "/count"; },
                              [&](const TopicDescription&, const SamplePtr& sample) { seen = sample; });
  std::shared_ptr<UntypedOutput> output;
  ComponentDescription writer = relay();
  writer.name = "writer";
  harness.container().add(writer, [&](Context& context) {
    output = context.open_output(TopicDescription{"count", "std_msgs/msg/Int16", interfaces::qos::kDefault, nullptr});
    return std::make_unique<Component>();
  });
  output->publish(interfaces::Bytes{0, 1, 0, 0, 7, 0});
  harness.container().run_until_quiet();
  output.reset();
  ASSERT_TRUE(seen);
  ASSERT_TRUE(seen->type());
  EXPECT_EQ(seen->type()->name, "std_msgs/msg/Int16");
  EXPECT_TRUE(seen->message());
}

TEST(Plugin, ThatIsNoComponentIsRefusedAndSaysWhatIsMissing) {
  ComponentDescription description = relay();
  description.package = "panvo_test_no";
  EXPECT_THAT(why_not(description), HasSubstr("is not a component plugin: it has no function panvo_components"));
  description.package = "panvo_test_unregistered";
  EXPECT_THAT(why_not(description), HasSubstr("registers no component"));
  EXPECT_FALSE(is_mapped("panvo_test_unregistered"));
}

TEST(Plugin, BuiltWithOtherHeadersIsRefusedAndSaysWhichBeforeAnyOfItsCodeIsCalled) {
  ComponentDescription description = relay();
  description.package = "panvo_test_stale";
  EXPECT_THAT(why_not(description),
              AllOf(HasSubstr("was built for panvo_runtime " + std::string(kRuntimeVersion) +
                              " (headers 000000000000, messages 000000000000), this is " + std::string(kRuntimeBuild)),
                    HasSubstr("build the plugin again")));
  EXPECT_THAT(std::string(kRuntimeBuild),
              testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+ \\(headers [0-9a-f]+, messages [0-9a-f]+\\)"));
}

/// Expects that a plugin is found in `folder` of the prefix in an environment variable.
void expect_found_in(const std::filesystem::path& folder, const char* variable) {
  const panvo::test::TemporaryFolder install;
  std::filesystem::create_directories(install / folder);
  const std::filesystem::path built =
      std::filesystem::path(std::getenv("PANVO_PLUGIN_PATH")) / "libpanvo_test_relay_component.so";
  std::filesystem::copy(built, install / folder / "libpanvo_moved_relay_component.so");
  setenv(variable, install.path().c_str(), 1);
  ComponentDescription description = relay();
  description.package = "panvo_moved_relay";
  EXPECT_EQ(why_not(description), "loaded");
  unsetenv(variable);
}

TEST(Plugin, IsFoundWhereColconInstallsEachPackageByItself) {
  expect_found_in("panvo_moved_relay/lib/panvo", "COLCON_PREFIX_PATH");
}

TEST(Plugin, IsFoundWhereDebianInstallsLibraries) {
  expect_found_in("lib/" PANVO_ARCHITECTURE "/panvo", "CMAKE_PREFIX_PATH");
  expect_found_in("panvo_moved_relay/lib/" PANVO_ARCHITECTURE "/panvo", "COLCON_PREFIX_PATH");
}

TEST(Plugin, ThatIsNotThereIsRefusedAndSaysWhereItWasLookedFor) {
  ComponentDescription description = relay();
  description.package = "panvo_nonesuch";
  EXPECT_THAT(why_not(description), HasSubstr("libpanvo_nonesuch_component.so is not in "));
}

TEST(Plugin, NamedByAPathIsRefusedWhateverLiesThere) {
  // A folder "libx" would turn "lib" + "x/../NAME" + "_component.so" into a path to any plugin.
  for (const char* name : {"/../../evil", "x/../panvo_test_relay", "..", "", "Panvo_test_relay"}) {
    ComponentDescription description = relay();
    description.package = name;
    EXPECT_THAT(why_not(description), HasSubstr("is not a package name")) << name;
  }
}

TEST(Plugin, WithoutThatComponentIsRefusedAndSaysWhichItHas) {
  ComponentDescription description = relay();
  description.plugin = "RelyComponent";
  EXPECT_THAT(
      why_not(description),
      HasSubstr(
          "has no component RelyComponent; it has CountComponent, BareComponent, BrokenComponent, RelayComponent"));
}

TEST(Plugin, WhoseComponentCannotBeMadeSaysWhyAndIsUnloaded) {
  ComponentDescription description = relay();
  description.plugin = "BrokenComponent";
  EXPECT_THAT(why_not(description), HasSubstr("no camera found"));
  EXPECT_FALSE(is_mapped("panvo_test_relay"));
}

TEST(Plugin, WithBadParametersNamesEveryOneWithItsLine) {
  ComponentDescription description = relay();
  description.parameters["copies"] = {{"0"}, false, {"system.yaml", 12}};
  description.parameters["copes"] = {{"2"}, false, {"system.yaml", 13}};
  const std::string problems = why_not(description);
  EXPECT_THAT(problems, HasSubstr("system.yaml:12"));
  EXPECT_THAT(problems, HasSubstr("system.yaml:13"));
  EXPECT_THAT(problems, HasSubstr("did you mean"));
}

/// Loads a relay and a component without parameters with a value for several nodes.
std::string why_not_all(ContainerOptions options, const std::string& parameter) {
  ComponentDescription first = relay(), second = relay();
  second.name = "other";
  second.plugin = "BareComponent";
  for (auto* description : {&first, &second}) description->parameters[parameter] = {{"2"}, false, {"p.yaml", 3}, true};
  Container container(std::move(options));
  try {
    container.load_all({first, second});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "loaded";
}

TEST(Plugin, IgnoresAValueForSeveralNodesThatAnotherOneHas) {
  EXPECT_EQ(why_not_all({.replay = true}, "copies"), "loaded");
}

TEST(Plugin, RefusesAValueForSeveralNodesThatNoneHas) {
  EXPECT_EQ(why_not_all({.replay = true}, "copes"),
            "p.yaml:3: no node has a parameter \"copes\"; did you mean \"copies\"?");
}

TEST(Plugin, OfAPartOfASystemWarnsOfAValueForSeveralNodesThatAnotherPartMayHave) {
  std::string log;
  const auto write = [&](LogLevel, const std::string&, const std::string& text) { log += text; };
  EXPECT_EQ(why_not_all({.replay = true, .log = write, .is_part_of_system = true}, "copes"), "loaded");
  EXPECT_THAT(log, HasSubstr("p.yaml:3: no node has a parameter \"copes\""));
}

}  // namespace
}  // namespace panvo::runtime
