// SPDX-License-Identifier: Apache-2.0
// Components in system files, and their errors.
#include "system_file_fixture.hpp"

namespace panvo::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

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

TEST_F(SystemFile, RefusesPluginsThatAreNamedByPaths) {
  EXPECT_THAT(problems("launch:\n- node_container:\n    name: x\n    composable_node:\n"
                       "    - {pkg: /../../evil, plugin: ../A, name: a}\n"),
              ElementsAre("stereo.yaml:5: pkg \"/../../evil\" is not a package name; use lower-case letters, digits "
                          "and '_', starting with a letter",
                          "stereo.yaml:5: plugin \"../A\" is not a class name; write Class or package::Class"));
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
                  "stereo.yaml:9: component /rectifier has the same name as the one at stereo.yaml:7; give it another "
                  "name or "
                  "namespace",
                  "stereo.yaml:10: composable_node key \"pkg\" is empty; name the package that has the plugin",
                  "stereo.yaml:12: composable_node lacks the key \"name\"; name the component",
                  "stereo.yaml:13: name \"a/b\" has a '/'; put the part before it into the key namespace",
                  "stereo.yaml:13: topic name \"left image\" has the character ' '; use letters, digits, '_' and '/' "
                  "only",
                  "stereo.yaml:14: composable_node key \"pkg\": there is no variable \"p\"; there are none",
                  "stereo.yaml:15: composable_node must be a map: lines \"key: value\"",
                  "stereo.yaml:16: argument \"needed\" is not given and has no default (what it is for); "
                  "pass a value or add a default",
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

}  // namespace
}  // namespace panvo::runtime
