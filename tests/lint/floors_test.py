# SPDX-License-Identifier: Apache-2.0
import floors
import sample

L = sample.LICENCE


class FloorsTest(sample.RuleTest):
    def test_a_whole_workspace_breaks_nothing(self):
        self.assertEqual(self.complaints(floors), [])

    def test_vision_knows_no_runtime(self):
        self.assert_finds(floors, "components/vision/src/a.cpp:2: panvo/runtime/logger.hpp: layer 'vision'",
                          {"components/vision/src/a.cpp": L + '#include "panvo/runtime/logger.hpp"\n'})

    def test_vision_knows_no_yaml_even_in_quotes(self):
        self.assert_finds(floors, "may not use yaml", {"components/vision/src/a.cpp": L + '#include "yaml-cpp/yaml.h"\n'})

    def test_calibration_files_know_yaml_but_no_message_and_no_log(self):
        file = "components/calibration_files/src/a.cpp"
        self.assertEqual(self.complaints(floors, {file: L + '#include <yaml-cpp/yaml.h>\n\n#include "panvo/vision/lens.hpp"\n'}), [])
        self.assert_finds(floors, "layer 'calibration files'", {file: L + '#include "panvo/runtime/logger.hpp"\n'})
        self.assert_finds(floors, "may not use log", {file: L + "#include <spdlog/spdlog.h>\n"})

    def test_readers_of_rigs_and_drivers_leave_yaml_to_calibration_files(self):
        for file in ("components/calibration/src/files/a.cpp", "drivers/camera_stream/src/a.cpp"):
            self.assert_finds(floors, "may not use yaml", {file: L + "#include <yaml-cpp/yaml.h>\n"})

    def test_an_algorithm_includes_no_generated_type(self):
        self.assert_finds(floors, "may not use messages", {
            "interfaces/idl/nav_msgs/msg/Odometry.idl": "", "components/compass/src/compass.cpp": L + '#include "nav_msgs/msg/Odometry.h"\n'})

    def test_an_algorithm_includes_no_other_component(self):
        self.assert_finds(floors, "may include only these panvo packages: landmarks, vision",
                          {"components/compass/src/compass.cpp": L + '#include "panvo/localizer/localizer.hpp"\n'})

    def test_an_algorithm_has_no_thread_and_no_clock(self):
        self.assert_finds(floors, "may not use threads", {"components/compass/src/compass.cpp": L + "#include <thread>\n"})
        self.assert_finds(floors, "may not read clocks", {"components/compass/src/compass.cpp": L + "#include <chrono>\n"})
        self.assert_finds(floors, "std::chrono::steady_clock".split("::")[2],
                          {"components/compass/src/compass.cpp": L + "auto now() { return std::chrono::steady_clock::now(); }\n"})

    def test_words_in_comments_and_strings_are_no_code(self):
        self.assertEqual(self.complaints(floors, {
            "components/compass/src/compass.cpp": L + '// no std::thread here\n/* nor a\n steady_clock */ const char* k = "std::async";\n'}), [])

    def test_a_wrapper_includes_no_fastdds_and_no_other_component(self):
        wrapper = "components/compass/src/compass_component.cpp"
        self.assert_finds(floors, "may not use fastdds", {wrapper: L + "#include <fastdds/dds/domain/DomainParticipant.hpp>\n"})
        self.assert_finds(floors, "layer 'component wrapper'", {wrapper: L + '#include "panvo/localizer/localizer.hpp"\n'})

    def test_what_is_compiled_into_the_plugin_is_the_wrapper(self):
        lists = sample.cmake_lists("panvo_compass") + (
            "panvo_add_component(panvo_compass_component\n  SOURCES src/compass_component.cpp src/messages.cpp\n  LINK x)\n")
        includes_runtime = L + '#pragma once\n#include "panvo/runtime/component.hpp"\n'
        for file in ("src/messages.cpp", "src/messages.hpp"):
            path = f"components/compass/{file}"
            self.assertEqual(self.complaints(floors, {"components/compass/CMakeLists.txt": lists, path: includes_runtime}), [])
            self.assert_finds(floors, "layer 'algorithm'", {path: includes_runtime})

    def test_the_runtime_keeps_dds_and_yaml_in_their_folders(self):
        dds, yaml = L + "#include <fastdds/dds/topic/Topic.hpp>\n", L + "#include <yaml-cpp/yaml.h>\n"
        self.assert_finds(floors, "may not use fastdds", {"components/runtime/src/context.cpp": dds})
        self.assert_finds(floors, "may not use yaml", {"components/runtime/src/dds/bridge.cpp": yaml})
        self.assertEqual(self.complaints(floors, {"components/runtime/src/dds/bridge.cpp": dds, "components/runtime/src/config/file.cpp": yaml}), [])

    def test_the_runtime_knows_no_topic_of_a_component(self):
        for include in ("panvo/interfaces/topics.hpp", "panvo_msgs/msg/LandmarkMatch.h"):
            text = L + f'#include "{include}"\n'
            self.assert_finds(floors, "knows no topic", {"components/runtime/src/context.cpp": text})
            message = "interfaces/idl/panvo_msgs/msg/LandmarkMatch.idl"
            self.assertEqual(self.complaints(floors, {message: "", "components/runtime/test/context_test.cpp": text}), [])

    def test_a_driver_includes_no_component(self):
        self.assert_finds(floors, "layer 'driver'", {"drivers/camera/src/camera.cpp": L + '#include "panvo/stereo_rectifier/x.hpp"\n'})

    def test_nobody_includes_the_evaluation(self):
        self.assert_finds(floors, "nothing may include evaluation",
                          {"components/compass/src/compass.cpp": L + '#include "panvo/evaluation/report.hpp"\n'})

    def test_a_library_nobody_knows_is_asked_about(self):
        self.assert_finds(floors, "unknown library", {"components/compass/src/compass.cpp": L + "#include <boost/any.hpp>\n"})

    def test_no_climbing_out_of_a_folder(self):
        self.assert_finds(floors, "leaves its package", {"components/compass/src/compass.cpp": L + '#include "../../vision/src/a.hpp"\n'})
