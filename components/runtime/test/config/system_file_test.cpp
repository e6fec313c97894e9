// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/system_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <stdlib.h>

#include "temporary_folder.hpp"

namespace panvo::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

constexpr const char* kStereo = R"(launch:
- arg: {name: rig, default: kitti, description: folder of the calibration}
- node_container:
    pkg: panvo_runtime
    exec: panvo_run
    name: stereo
    namespace: ""
    composable_node:
    - pkg: panvo_stereo_rectifier
      plugin: StereoRectifierComponent
      name: stereo_rectifier
      namespace: robot
      remap:
      - {from: stereo/left/image_raw, to: /camera/left}
    - pkg: panvo_binocular_odometry
      plugin: BinocularOdometryComponent
      name: binocular_odometry
      param:
      - {name: front_end, value: $(var rig)_sift}
      - name: tracker
        param:
        - {name: max_features, value: 500}
      - {name: weights, value: [1, 2.5]}
      extra_arg:
      - {name: use_intra_process_comms, value: "true"}
)";

class SystemFile : public testing::Test {
 protected:
  /// The problems of a system file, each without the folder of this test.
  std::vector<std::string> problems(const std::string& content,
                                    const std::map<std::string, std::string>& arguments = {}) {
    return problems_of(folder_.write("stereo.yaml", content), arguments);
  }

  std::vector<std::string> problems_of(const std::filesystem::path& file,
                                       const std::map<std::string, std::string>& arguments = {}) {
    try {
      read_system_file(file, arguments);
      return {};
    } catch (const ConfigError& error) {
      return without_folder(error.problems());
    }
  }

  std::vector<std::string> without_folder(std::vector<std::string> texts) {
    const auto prefix = folder_.path().string() + "/";
    for (auto& text : texts) {
      for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
        text.erase(at, prefix.size());
      }
    }
    return texts;
  }

  /// A system of one component with these lines in it, the first of them line 7.
  static std::string with(const std::string& lines) {
    return "launch:\n- node_container:\n    name: stereo\n    composable_node:\n    - {pkg: p, plugin: P, "
           "name: other}\n"
           "    - {pkg: p, plugin: P, name: odometry,\n" +
           lines + "}\n";
  }

  WrittenValues parameters_of(const std::string& lines) {
    return read_system_file(folder_.write("stereo.yaml", with(lines))).containers.at(0).components.at(1).parameters;
  }

  TemporaryFolder folder_;
};

TEST_F(SystemFile, SaysWhichProcessesLoadWhichComponents) {
  const auto system = read_system_file(folder_.write("stereo.yaml", kStereo));
  ASSERT_EQ(system.containers.size(), 1U);
  const auto& container = system.containers[0];
  EXPECT_EQ(container.name, "stereo");
  EXPECT_EQ(container.name_space, "/");
  ASSERT_EQ(container.components.size(), 2U);

  const auto& rectifier = container.components[0];
  EXPECT_EQ(rectifier.package, "panvo_stereo_rectifier");
  EXPECT_EQ(rectifier.plugin, "StereoRectifierComponent");
  EXPECT_EQ(rectifier.name, "stereo_rectifier");
  EXPECT_EQ(rectifier.name_space, "/robot");
  EXPECT_EQ(rectifier.where.line, 9);
  EXPECT_THAT(rectifier.remaps, ElementsAre(Pair("stereo/left/image_raw", "/camera/left")));

  const auto& parameters = container.components[1].parameters;
  ASSERT_EQ(parameters.size(), 3U);
  EXPECT_THAT(parameters.at("front_end").items, ElementsAre("kitti_sift"));
  EXPECT_EQ(parameters.at("front_end").where.line, 19);
  EXPECT_THAT(parameters.at("tracker.max_features").items, ElementsAre("500"));
  EXPECT_EQ(parameters.at("tracker.max_features").where.to_string(), (folder_.path() / "stereo.yaml:22").string());
  EXPECT_TRUE(parameters.at("weights").is_list);
  EXPECT_THAT(parameters.at("weights").items, ElementsAre("1", "2.5"));
  EXPECT_THAT(without_folder(system.notes),
              ElementsAre("stereo.yaml:24: composable_node key \"extra_arg\" has no effect here"));
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
              ElementsAre("stereo.yaml:4: max_topic_rate_hz is \"fast\"; write messages a second, 0 to 1000000"));
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
        ElementsAre(fmt::format("stereo.yaml:4: shared_images_mb is \"{}\"; write megabytes, 0 (none are shared) "
                                "to 64",
                                size)));
  }
}

/// One container with `line` of it and `more` of its component.
std::string with_line(const std::string& line, const std::string& more = "") {
  return fmt::format(
      "launch:\n- node_container:\n    name: x\n{}    composable_node:\n    - {{pkg: panvo_a, plugin: A, name: a{}}}\n",
      line.empty() ? "" : "    " + line + "\n", more);
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
              ElementsAre("stereo.yaml:4: services is \"nobody\"; known are: look, steer, off"));
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
  EXPECT_THAT(problems(with_line("files_below: nowhere")), ElementsAre(HasSubstr("there is no folder \"nowhere\"")));
  const auto limited = folder_.write("limited.yaml", with_line("requests_per_s: 5"));
  EXPECT_EQ(read_system_file(limited).containers[0].requests_per_s, 5);
  EXPECT_THAT(problems(with_line("requests_per_s: -1")),
              ElementsAre("stereo.yaml:4: requests_per_s is \"-1\"; write how many a second, 0 to 100000"));
}

TEST_F(SystemFile, RefusesPluginsThatAreNamedByPaths) {
  EXPECT_THAT(problems("launch:\n- node_container:\n    name: x\n    composable_node:\n"
                       "    - {pkg: /../../evil, plugin: ../A, name: a}\n"),
              ElementsAre("stereo.yaml:5: pkg \"/../../evil\" is no name of a package; write small letters, digits and "
                          "'_', a letter first",
                          "stereo.yaml:5: plugin \"../A\" is no name of a class; write Class or package::Class"));
}

TEST_F(SystemFile, TakesArgumentsAndRefusesThoseItDoesNotDeclare) {
  const auto file = folder_.write("stereo.yaml", kStereo);
  const auto system = read_system_file(file, {{"rig", "euroc"}});
  EXPECT_THAT(system.containers[0].components[1].parameters.at("front_end").items, ElementsAre("euroc_sift"));
  EXPECT_THAT(problems_of(file, {{"rgi", "euroc"}}),
              ElementsAre("stereo.yaml: stereo.yaml has no argument \"rgi\"; did you mean \"rig\"?"));
}

TEST_F(SystemFile, NamesFilesThatAreNotThereNotReadableOrEmpty) {
  EXPECT_THAT(problems_of(folder_.path() / "none.yaml"), ElementsAre("none.yaml: no such file; check the path"));
  EXPECT_THAT(problems(""), ElementsAre("stereo.yaml: is empty"));
  std::filesystem::create_directory(folder_.path() / "folder.yaml");
  EXPECT_THAT(problems_of(folder_.path() / "folder.yaml"),
              ElementsAre("folder.yaml: is a folder; name a YAML file in it"));
}

TEST_F(SystemFile, NamesTheLineOfASyntaxError) {
  EXPECT_THAT(problems("launch:\n- node_container: {name: a\n- group: []\n"),
              ElementsAre(testing::AllOf(HasSubstr("stereo.yaml:3: is not YAML: "), HasSubstr("check indentation"))));
}

TEST_F(SystemFile, NeedsAListOfWhatToLaunch) {
  const auto no_list = "stereo.yaml: has no list \"launch\"; begin it with \"launch:\", below it \"- node_container:\"";
  EXPECT_THAT(problems("lanch: []\n"), ElementsAre(no_list));
  EXPECT_THAT(problems("just text\n"), ElementsAre(no_list));
  EXPECT_THAT(problems("launch: 3\n"),
              ElementsAre(HasSubstr("stereo.yaml:1: a system file key \"launch\" must be a list")));
  EXPECT_THAT(problems("launch:\n"), ElementsAre(HasSubstr("must be a list")));
  EXPECT_THAT(problems("launch: []\n"), ElementsAre(HasSubstr("loads nothing; add a node_container")));
  EXPECT_THAT(problems("launch:\n- node_container: {name: a}\n"),
              ElementsAre(HasSubstr("stereo.yaml:2: node_container a loads nothing; add a list composable_node")));
}

TEST_F(SystemFile, ListsAllProblemsInOrderOfLine) {
  EXPECT_THAT(
      problems(R"(launch:
- node_contaner: {}
- node_container:
    name: stereo
    nmespace: robot
    composable_node:
    - pkg: panvo_stereo_rectifier
      name: rectifier
    - plugin: P
      pkg: ""
      name: rectifier
    - {pkg: p, plugin: P}
    - {pkg: p, plugin: P, name: a/b, remap: [{from: left image, to: x}]}
    - {pkg: $(var p), plugin: P, name: c}
    - text
- arg: {name: needed, description: what it is for}
lauch: []
)"),
      ElementsAre("stereo.yaml:2: there is no entry \"node_contaner\"; did you mean \"node_container\"?",
                  "stereo.yaml:5: node_container has no key \"nmespace\"; did you mean \"namespace\"?",
                  "stereo.yaml:7: composable_node lacks the key \"plugin\"; name the component's class",
                  "stereo.yaml:9: component /rectifier has the name of what is at stereo.yaml:7; give it another "
                  "name or "
                  "namespace",
                  "stereo.yaml:10: composable_node key \"pkg\" is empty; name the package that has the plugin",
                  "stereo.yaml:12: composable_node lacks the key \"name\"; name the component",
                  "stereo.yaml:13: name \"a/b\" has a '/'; put what is before it into the key namespace",
                  "stereo.yaml:13: topic name \"left image\" has the character ' '; use letters, digits, '_' and '/' "
                  "only",
                  "stereo.yaml:14: composable_node key \"pkg\": there is no variable \"p\"; there are none",
                  "stereo.yaml:15: composable_node must be a map: lines \"key: value\"",
                  "stereo.yaml:16: argument \"needed\" is not given and has no default (what it is for); give it one",
                  "stereo.yaml:17: a system file has no key \"lauch\"; did you mean \"launch\"?"));
}

TEST_F(SystemFile, NamesParametersThatAreDoubledOrHaveNoUsableValue) {
  EXPECT_THAT(
      problems(with(R"(       param: [{name: a, value: 1},
         {name: a, value: 2},
         {name: b},
         {name: c, value: },
         {name: d, value: [[1], 2]},
         {nane: e, value: 2},
         {name: f, value: {x: 1}},
         text])")),
      ElementsAre("stereo.yaml:8: parameter a is given twice, first at stereo.yaml:7; keep one",
                  "stereo.yaml:9: param b lacks the key \"value\"",
                  "stereo.yaml:10: parameter c has no value; write \"\" for an empty text",
                  "stereo.yaml:11: parameter d must be one value or a list of values, not lists or maps within a "
                  "list",
                  "stereo.yaml:12: param lacks the key \"name\"; write {name: NAME, value: VALUE} or {from: FILE}",
                  "stereo.yaml:12: param has no key \"nane\"; did you mean \"name\"?",
                  "stereo.yaml:13: parameter f must be one value or a list of values, not lists or maps within a "
                  "list",
                  "stereo.yaml:14: param must be a map: lines \"key: value\""));
}

TEST_F(SystemFile, NamesKeysThatAreDoubled) {
  EXPECT_THAT(problems("launch:\n- node_container:\n    name: a\n    name: b\n    composable_node: []\n"),
              ElementsAre("stereo.yaml:4: node_container has \"name\" twice, first at stereo.yaml:3"));
}

TEST_F(SystemFile, SubstitutesEnvironmentFolderAndPackages) {
  setenv("PANVO_TEST_NAME", "from the environment", 1);
  unsetenv("PANVO_TEST_NONE");
  folder_.write("merged/share/rig_a/x", "");
  folder_.write("isolated/rig_b/share/rig_b/x", "");
  setenv("AMENT_PREFIX_PATH", (folder_.path() / "merged").c_str(), 1);
  setenv("COLCON_PREFIX_PATH", ("/nowhere:" + (folder_.path() / "isolated").string()).c_str(), 1);
  const auto parameters = parameters_of(R"(       param: [{name: env, value: $(env PANVO_TEST_NAME)},
         {name: default, value: $(env PANVO_TEST_NONE 'by default')},
         {name: nested, value: "<$(env $(env PANVO_TEST_NONE PANVO_TEST_NAME))>"},
         {name: dirname, value: $(dirname)/rigs},
         {name: merged, value: $(find-pkg-share rig_a)/a.yaml},
         {name: isolated, value: $(find-pkg-share rig_b)}])");
  EXPECT_THAT(parameters.at("env").items, ElementsAre("from the environment"));
  EXPECT_THAT(parameters.at("default").items, ElementsAre("by default"));
  EXPECT_THAT(parameters.at("nested").items, ElementsAre("<from the environment>"));
  EXPECT_THAT(parameters.at("dirname").items, ElementsAre((folder_.path() / "rigs").string()));
  EXPECT_THAT(parameters.at("merged").items, ElementsAre((folder_.path() / "merged/share/rig_a/a.yaml").string()));
  EXPECT_THAT(parameters.at("isolated").items, ElementsAre((folder_.path() / "isolated/rig_b/share/rig_b").string()));
}

TEST_F(SystemFile, SaysWhatIsWrongWithASubstitution) {
  unsetenv("PANVO_TEST_NONE");
  EXPECT_THAT(problems(with(R"(       param: [{name: a, value: $(env PANVO_TEST_NONE)},
         {name: b, value: $(find-pkg-share no_such_package)},
         {name: c, value: $(evn HOME)},
         {name: d, value: "$(var x"},
         {name: e, value: $(var )}])")),
              ElementsAre("stereo.yaml:7: parameter a: the environment has no PANVO_TEST_NONE; set it, or write "
                          "$(env PANVO_TEST_NONE "
                          "DEFAULT)",
                          HasSubstr("stereo.yaml:8: parameter b: no share folder of package no_such_package in "
                                    "AMENT_PREFIX_PATH or"),
                          "stereo.yaml:9: parameter c: there is no substitution $(evn); did you mean \"env\"?",
                          "stereo.yaml:10: parameter d: \"$(var x\" lacks its closing parenthesis",
                          "stereo.yaml:11: parameter e: $(var) needs a name"));
}

TEST_F(SystemFile, LoadsWhatItsConditionsAllow) {
  const auto file = folder_.write("stereo.yaml", R"(launch:
- arg: {name: panorama, default: "false"}
- node_container:
    name: a
    composable_node:
    - {pkg: p, plugin: P, name: always}
    - {pkg: p, plugin: P, name: with, if: $(var panorama)}
    - {pkg: p, plugin: P, name: without, unless: $(var panorama)}
- node_container: {name: b, if: $(var panorama), composable_node: []}
)");
  const auto without = read_system_file(file);
  ASSERT_EQ(without.containers.size(), 1U);
  EXPECT_EQ(without.containers[0].components.at(1).name, "without");
  const auto with = read_system_file(file, {{"panorama", "true"}});
  ASSERT_EQ(with.containers.size(), 2U);
  EXPECT_EQ(with.containers[0].components.at(1).name, "with");
  EXPECT_THAT(problems_of(file, {{"panorama", "perhaps"}}),
              testing::Contains("stereo.yaml:7: composable_node key \"if\" = perhaps: must be true or false"));
}

TEST_F(SystemFile, GroupsHoldTheirNamespaceToTheirEnd) {
  const auto system = read_system_file(folder_.write("stereo.yaml", R"(launch:
- group:
  - push_ros_namespace: {namespace: fleet}
  - group:
    - push_ros_namespace: {namespace: robot}
    - node_container: {name: a, namespace: x, composable_node: [{pkg: p, plugin: P, name: odometry}]}
  - node_container: {name: a, composable_node: [{pkg: p, plugin: P, name: odometry, namespace: /abs}]}
- node_container: {name: a, composable_node: [{pkg: p, plugin: P, name: odometry}]}
)"));
  ASSERT_EQ(system.containers.size(), 3U);
  EXPECT_EQ(system.containers[0].name_space, "/fleet/robot/x");
  EXPECT_EQ(system.containers[0].components[0].name_space, "/fleet/robot");
  EXPECT_EQ(system.containers[1].name_space, "/fleet");
  EXPECT_EQ(system.containers[1].components[0].name_space, "/abs");
  EXPECT_EQ(system.containers[2].name_space, "/");
}

TEST_F(SystemFile, IncludesOthersWithArguments) {
  folder_.write("parts/odometry.yaml", R"(launch:
- arg: {name: front_end, default: klt}
- arg: {name: rig}
- node_container:
    name: $(var front_end)
    composable_node:
    - {pkg: p, plugin: P, name: odometry_$(var front_end), param: [{name: rig, value: $(var rig)}, {from: p.yaml}]}
)");
  folder_.write("parts/p.yaml", "/**: {ros__parameters: {gain: 1}}\n");
  const auto system = read_system_file(folder_.write("stereo.yaml", R"(launch:
- let: {name: rig, value: kitti}
- include: {file: parts/odometry.yaml}
- group:
  - include: {file: $(dirname)/parts/odometry.yaml, arg: [{name: front_end, value: sift}]}
)"));
  ASSERT_EQ(system.containers.size(), 2U);
  EXPECT_EQ(system.containers[0].components[0].name, "odometry_klt");
  EXPECT_THAT(system.containers[0].components[0].parameters.at("rig").items, ElementsAre("kitti"));
  EXPECT_THAT(system.containers[0].components[0].parameters.at("gain").items, ElementsAre("1"));
  EXPECT_EQ(system.containers[1].components[0].name, "odometry_sift");
}

TEST_F(SystemFile, RefusesIncludesThatAreNotThereOrGoRound) {
  folder_.write("b.yaml", "launch:\n- include: {file: ./stereo.yaml}\n");
  EXPECT_THAT(
      problems("launch:\n- include: {file: none.yaml}\n- include: {file: b.yaml, arg: [{name: x, value: 1}]}\n"),
      ElementsAre("stereo.yaml:2: none.yaml: no such file; check the path",
                  "stereo.yaml:3: b.yaml has no argument \"x\"; there are none",
                  "b.yaml:2: the file includes itself: stereo.yaml -> b.yaml -> stereo.yaml; take out one include"));
}

TEST_F(SystemFile, ReadsParameterFilesOfRos) {
  folder_.write("p.yaml", R"(/**:
  ros__parameters:
    gain: 1
    tracker:
      max_features: 300
      radius: [1, 2]
other:
  ros__parameters: {gain: 2}
/odometry:
  ros__parameters: {gain: 3, path: $(dirname)}
)");
  auto parameters = parameters_of("       param: [{from: p.yaml}, {name: tracker.max_features, value: 400}]");
  EXPECT_EQ(parameters.size(), 4U);
  EXPECT_THAT(parameters.at("gain").items, ElementsAre("3"));
  EXPECT_EQ(parameters.at("gain").where.to_string(), (folder_.path() / "p.yaml:10").string());
  EXPECT_THAT(parameters.at("tracker.max_features").items, ElementsAre("400"));
  EXPECT_THAT(parameters.at("tracker.radius").items, ElementsAre("1", "2"));
  EXPECT_THAT(parameters.at("path").items, ElementsAre("$(dirname)"));
  parameters = parameters_of("       param: [{from: p.yaml, allow_substs: true}]");
  EXPECT_THAT(parameters.at("path").items, ElementsAre(folder_.path().string()));
}

TEST_F(SystemFile, NamesWhatIsWrongInAParameterFile) {
  const auto from = with("       param: [{from: p.yaml}]");
  EXPECT_THAT(problems(from), ElementsAre("stereo.yaml:7: p.yaml: no such file; check the path"));
  folder_.write("p.yaml", "gain: 1\n");
  EXPECT_THAT(problems(from), ElementsAre(HasSubstr("p.yaml: has no parameters; write the node's name"),
                                          "p.yaml:1: section gain must be a map with ros__parameters"));
  folder_.write("p.yaml", "/**:\n  ros__parameters:\n    a: 1\n    a: 2\n    b:\n    c: [{x: 1}]\n");
  EXPECT_THAT(
      problems(from),
      ElementsAre("p.yaml:4: parameter a is given twice in one section; keep one",
                  "p.yaml:5: parameter b has no value; write \"\" for an empty text",
                  "p.yaml:6: parameter c must be one value or a list of values, not lists or maps within a list"));
  folder_.write("p.yaml", "/**: &again\n  ros__parameters:\n    a: 1\n  deeper: *again\n");
  EXPECT_THAT(problems(from), testing::Not(IsEmpty())) << "a map that contains itself";
}

TEST_F(SystemFile, NotesAParameterFileThatSaysNothingToItsComponent) {
  folder_.write("p.yaml", "odometri: {ros__parameters: {gain: 1}}\n");
  const auto system = read_system_file(folder_.write("stereo.yaml", with("       param: [{from: p.yaml}]")));
  EXPECT_THAT(without_folder(system.notes),
              ElementsAre("stereo.yaml:7: p.yaml says nothing to /odometry; its sections are for odometri"));
}

TEST_F(SystemFile, SettingsOverrideWhatIsWritten) {
  auto system = read_system_file(folder_.write("stereo.yaml", kStereo));
  apply_setting(system, "binocular_odometry.tracker.max_features=700");
  apply_setting(system, "binocular_odometry.note=a=b");
  apply_setting(system, "/robot/stereo_rectifier.sizes=[1, 2]");
  apply_setting(system, "binocular_odometry.empty=");
  const auto& components = system.containers[0].components;
  const auto& parameters = components[1].parameters;
  EXPECT_THAT(parameters.at("tracker.max_features").items, ElementsAre("700"));
  EXPECT_EQ(parameters.at("tracker.max_features").where.to_string(), "--set");
  EXPECT_THAT(parameters.at("note").items, ElementsAre("a=b"));
  EXPECT_THAT(parameters.at("empty").items, ElementsAre(""));
  EXPECT_TRUE(components[0].parameters.at("sizes").is_list);
  EXPECT_THAT(components[0].parameters.at("sizes").items, ElementsAre("1", "2"));
}

TEST_F(SystemFile, RefusesSettingsOfNoComponentOrNoValue) {
  auto system = read_system_file(folder_.write("stereo.yaml", kStereo));
  const auto refusal = [&](const std::string& setting) -> std::string {
    try {
      apply_setting(system, setting);
      return "";
    } catch (const ConfigError& error) {
      return without_folder({error.what()})[0];
    }
  };
  EXPECT_EQ(refusal("odometry.gain=1"),
            "--set odometry.gain=1: there is no component \"odometry\"; stereo.yaml has stereo_rectifier, "
            "binocular_odometry");
  for (const char* setting : {"gain", "odometry.gain", "=1", ".gain=1", "odometry.=1", "odometry=a.b"}) {
    EXPECT_THAT(refusal(setting), HasSubstr("write COMPONENT.PARAMETER=VALUE")) << setting;
  }
  EXPECT_THAT(refusal("binocular_odometry.weights=[1, 2"), HasSubstr("the list does not end"));
  EXPECT_THAT(refusal("binocular_odometry.weights=[1, [2]]"), HasSubstr("a list holds single values"));
}

}  // namespace
}  // namespace panvo::runtime
