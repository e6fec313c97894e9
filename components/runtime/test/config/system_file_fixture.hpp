// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "panvo/runtime/system_file.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::runtime {

inline constexpr const char* kStereo = R"(launch:
- arg: {name: rig, default: kitti, description: folder of the calibration}
- node_container:
    pkg: panvo_runner
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
  /// The problems of a system file, without the test's folder.
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

  /// A system with one component that contains `lines`, starting at line 7.
  static std::string with(const std::string& lines) {
    return "launch:\n- node_container:\n    name: stereo\n    composable_node:\n    - {pkg: p, plugin: P, "
           "name: other}\n"
           "    - {pkg: p, plugin: P, name: odometry,\n" +
           lines + "}\n";
  }

  WrittenValues parameters_of(const std::string& lines) {
    return read_system_file(folder_.write("stereo.yaml", with(lines))).containers.at(0).components.at(1).parameters;
  }

  panvo::test::TemporaryFolder folder_;
};

}  // namespace panvo::runtime
