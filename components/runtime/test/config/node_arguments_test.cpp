// SPDX-License-Identifier: Apache-2.0
// ROS 2's arguments of nodes: -p and -r.
#include "panvo/runtime/names.hpp"
#include "system_file_fixture.hpp"

namespace panvo::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class NodeArguments : public SystemFile {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& container : system.containers) {
      names.push_back(full_name(container.name_space, container.name));
      for (const auto& component : container.components)
        names.push_back(full_name(component.name_space, component.name));
    }
    return names;
  }
  template <class Apply>
  std::string problem(const Apply& apply, const std::string& argument) {
    try {
      apply(system, argument);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }

  SystemDescription system = read_system_file(folder_.write("stereo.yaml", kStereo));
};

TEST_F(NodeArguments, PutAllNodesIntoANamespace) {
  apply_remap(system, "__ns:=/fleet/one");
  EXPECT_THAT(names(),
              ElementsAre("/fleet/one/stereo", "/fleet/one/robot/stereo_rectifier", "/fleet/one/binocular_odometry"));
}

TEST_F(NodeArguments, NameTheContainerOrOneNode) {
  apply_remap(system, "__node:=eyes");
  apply_remap(system, "stereo_rectifier:__ns:=/left");
  apply_remap(system, "/binocular_odometry:__node:=odometry");
  EXPECT_THAT(names(), ElementsAre("/eyes", "/left/stereo_rectifier", "/odometry"));
}

TEST_F(NodeArguments, RemapTopics) {
  apply_remap(system, "tf:=/robot/tf");
  apply_remap(system, "stereo_rectifier:stereo/left/image_raw:=/zed/left");
  const auto& components = system.containers[0].components;
  EXPECT_EQ(components[0].remaps.at("tf"), "/robot/tf");
  EXPECT_EQ(components[0].remaps.at("stereo/left/image_raw"), "/zed/left");  // instead of the file's
  EXPECT_EQ(components[1].remaps.size(), 1U);
}

TEST_F(NodeArguments, RemapTopicsThatTheFileWritesInAnotherForm) {
  apply_remap(system, "stereo_rectifier:/robot/stereo/left/image_raw:=/zed/left");
  apply_remap(system, "stereo_rectifier:~/status:=/first");
  apply_remap(system, "stereo_rectifier:/robot/stereo_rectifier/status:=/second");
  const auto& rectifier = system.containers[0].components[0];
  const auto resolved = [&](const char* topic) {
    return resolve_topic(rectifier.name_space, rectifier.name, rectifier.remaps, topic);
  };
  EXPECT_EQ(resolved("stereo/left/image_raw"), "/zed/left");
  EXPECT_EQ(resolved("~/status"), "/second");
  apply_remap(system, "stereo/left/image_raw:=/last");
  EXPECT_EQ(resolved("stereo/left/image_raw"), "/last");
}

TEST_F(NodeArguments, SetParameters) {
  apply_parameter(system, "use_sim_time:=true");
  apply_parameter(system, "binocular_odometry:weights:=[3, 4.5]");
  const auto& container = system.containers[0];
  EXPECT_THAT(container.parameters.at("use_sim_time").items, ElementsAre("true"));
  for (const auto& component : container.components)
    EXPECT_THAT(component.parameters.at("use_sim_time").items, ElementsAre("true"));
  EXPECT_THAT(container.components[1].parameters.at("weights").items, ElementsAre("3", "4.5"));
  EXPECT_FALSE(container.components[0].parameters.contains("weights"));
  EXPECT_TRUE(container.components[1].parameters.at("use_sim_time").is_for_several);
  EXPECT_FALSE(container.components[1].parameters.at("weights").is_for_several);
}

TEST_F(NodeArguments, SayWhatIsWrong) {
  EXPECT_THAT(problem(apply_remap, "__ns:=fleet"), HasSubstr("starts with /"));
  EXPECT_THAT(problem(apply_remap, "__ns:=/1"), HasSubstr("namespace /1"));
  EXPECT_THAT(problem(apply_remap, "__node:=a b"), HasSubstr("name a b"));
  EXPECT_THAT(problem(apply_remap, "nobody:__node:=one"), HasSubstr("no node nobody"));
  EXPECT_THAT(problem(apply_remap, "image"), HasSubstr("write [NODE:]NAME:=VALUE"));
  EXPECT_THAT(problem(apply_remap, "image:=a//b"), HasSubstr("topic name"));
  EXPECT_THAT(problem(apply_parameter, "gain=5"), HasSubstr("write [NODE:]NAME:=VALUE"));
  EXPECT_THAT(problem(apply_parameter, "nobody:gain:=5"), HasSubstr("no node nobody"));
  EXPECT_THAT(problem(apply_parameter, "gain:=[1"), HasSubstr("[1, 2]"));
  apply_remap(system, "stereo_rectifier:__ns:=/");
  EXPECT_THAT(problem(apply_remap, "stereo_rectifier:__node:=binocular_odometry"),
              HasSubstr("two nodes would have the name /binocular_odometry"));
}

TEST_F(NodeArguments, OfAContainerAreReadFromItsFile) {
  const auto read = read_system_file(folder_.write("container.yaml", R"(launch:
- node_container:
    name: stereo
    param: [{name: use_sim_time, value: true}, {name: thread_num, value: 4}]
    composable_node: [{pkg: p, plugin: P, name: other}]
)"));
  EXPECT_EQ(read.containers[0].parameters.size(), 1U);
  EXPECT_THAT(read.containers[0].parameters.at("use_sim_time").items, ElementsAre("true"));
  EXPECT_THAT(read.notes, ElementsAre(HasSubstr("thread_num")));
}

}  // namespace
}  // namespace panvo::runtime
