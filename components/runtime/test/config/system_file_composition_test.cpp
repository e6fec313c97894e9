// SPDX-License-Identifier: Apache-2.0
// Composition of system files: substitutions, conditions, groups, includes, files and parameter settings.
#include <stdlib.h>

#include "system_file_fixture.hpp"

namespace panvo::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

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
              ElementsAre("stereo.yaml:7: parameter a: the environment variable PANVO_TEST_NONE is not set; set "
                          "it, or write $(env PANVO_TEST_NONE "
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

TEST_F(SystemFile, RemapsTopicsOfAllComponentsThatFollowToTheEndOfTheGroup) {
  const auto system = read_system_file(folder_.write("stereo.yaml", R"(launch:
- group:
  - set_remap: {from: /tf, to: tf}
  - set_remap: {from: image, to: picture}
  - node_container:
      name: a
      composable_node:
      - {pkg: p, plugin: P, name: one}
      - {pkg: p, plugin: P, name: two, remap: [{from: image, to: photo}]}
- node_container: {name: b, composable_node: [{pkg: p, plugin: P, name: three}]}
)"));
  const std::map<std::string, std::string> of_all{{"/tf", "tf"}, {"image", "picture"}};
  EXPECT_EQ(system.containers[0].components[0].remaps, of_all);
  EXPECT_EQ(system.containers[0].components[1].remaps.at("/tf"), "tf");
  EXPECT_EQ(system.containers[0].components[1].remaps.at("image"), "photo");
  EXPECT_TRUE(system.containers[1].components[0].remaps.empty());
}

TEST_F(SystemFile, RemapsATopicAsItsInnermostRuleSaysInWhateverForm) {
  const auto system = read_system_file(folder_.write("stereo.yaml", R"(launch:
- set_remap: {from: /scan, to: /of_all}
- group:
  - set_remap: {from: scan, to: /of_group}
  - node_container:
      name: a
      composable_node:
      - {pkg: p, plugin: P, name: one}
      - {pkg: p, plugin: P, name: two, remap: [{from: scan, to: /own}]}
      - {pkg: p, plugin: P, name: three, namespace: robot, remap: [{from: /robot/scan, to: /own}]}
- node_container: {name: b, composable_node: [{pkg: p, plugin: P, name: four, remap: [{from: scan, to: /own}]}]}
)"));
  const auto& components = system.containers[0].components;
  EXPECT_THAT(components[0].remaps, ElementsAre(Pair("scan", "/of_group")));
  EXPECT_THAT(components[1].remaps, ElementsAre(Pair("scan", "/own")));
  EXPECT_THAT(components[2].remaps, ElementsAre(Pair("/robot/scan", "/own"), Pair("/scan", "/of_all")));
  EXPECT_THAT(system.containers[1].components[0].remaps, ElementsAre(Pair("scan", "/own")));
}

TEST_F(SystemFile, RefusesTwoRemapsOfOneTopicInWhateverForm) {
  const char* twice = "stereo.yaml:7: topic /odometry/x is remapped twice; keep one";
  EXPECT_THAT(problems(with("       remap: [{from: ~/x, to: a}, {from: /odometry/x, to: b}]")), ElementsAre(twice));
  EXPECT_THAT(problems(with("       remap: [{from: /odometry/x, to: a}, {from: /odometry/x, to: a}]")),
              ElementsAre(twice));
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
                  "b.yaml:2: the file includes itself: stereo.yaml -> b.yaml -> stereo.yaml; remove one include"));
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
  EXPECT_FALSE(parameters.at("gain").is_for_several);
  EXPECT_THAT(parameters.at("tracker.max_features").items, ElementsAre("400"));
  EXPECT_FALSE(parameters.at("tracker.max_features").is_for_several);
  EXPECT_TRUE(parameters.at("tracker.radius").is_for_several) << "from a section with a wildcard";
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
}

TEST_F(SystemFile, BearsAliasesThatRepeatTooMuch) {
  const auto from = with("       param: [{from: p.yaml}]");
  for (const char* endless :
       {"/**: &again {deeper: *again}\n", "/**: {ros__parameters: &again {a: *again, b: *again, c: *again}}\n"}) {
    folder_.write("p.yaml", endless);
    EXPECT_THAT(problems(from), ElementsAre(HasSubstr("p.yaml: is nested too deep, or its aliases"))) << endless;
  }
  for (const std::string& endless : {std::string("launch:\n- group: &again\n  - group: *again\n"),
                                     with("       param: &again [{name: a, param: *again}]")}) {
    EXPECT_THAT(problems(endless), ElementsAre(HasSubstr("stereo.yaml: is nested too deep, or its aliases")))
        << endless;
  }
  std::string twice = "a0: &a0 {ros__parameters: {x: 1}}\n";  // each map is twice the one before
  for (int i = 1; i < 64; ++i) {
    const auto name = std::to_string(i), before = "*a" + std::to_string(i - 1);
    twice += "a" + name + ": &a" + name + " {a: " + before + ", b: " + before + "}\n";
  }
  folder_.write("p.yaml", twice);
  EXPECT_THAT(problems(from), ElementsAre(HasSubstr("p.yaml: is nested too deep, or its aliases")));
}

TEST_F(SystemFile, NotesAParameterFileThatSaysNothingToItsComponent) {
  folder_.write("p.yaml", "odometri: {ros__parameters: {gain: 1}}\n");
  const auto system = read_system_file(folder_.write("stereo.yaml", with("       param: [{from: p.yaml}]")));
  EXPECT_THAT(without_folder(system.notes),
              ElementsAre("stereo.yaml:7: p.yaml has no parameters for /odometry; its sections are for odometri"));
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
            "--set odometry.gain=1: unknown component \"odometry\"; stereo.yaml has stereo_rectifier, "
            "binocular_odometry");
  for (const char* setting : {"gain", "odometry.gain", "=1", ".gain=1", "odometry.=1", "odometry=a.b"}) {
    EXPECT_THAT(refusal(setting), HasSubstr("write COMPONENT.PARAMETER=VALUE")) << setting;
  }
  EXPECT_THAT(refusal("binocular_odometry.weights=[1, 2"), HasSubstr("the list is not closed"));
  EXPECT_THAT(refusal("binocular_odometry.weights=[1, [2]]"), HasSubstr("list items must be single values"));
}

}  // namespace
}  // namespace panvo::runtime
