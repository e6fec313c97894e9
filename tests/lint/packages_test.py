# SPDX-License-Identifier: Apache-2.0
import packages
import sample


class PackagesTest(sample.RuleTest):
    def test_a_whole_workspace_breaks_nothing(self):
        self.assertEqual(self.complaints(packages), [])

    def test_a_folder_without_package_xml(self):
        self.assert_finds(packages, "components/vision: has no package.xml", {"components/vision/package.xml": None})

    def test_a_package_called_otherwise_than_its_folder(self):
        self.assert_finds(packages, "must be panvo_vision", {"components/vision/package.xml": sample.package_xml("panvo_sight")})

    def test_a_project_called_otherwise_than_its_folder(self):
        self.assert_finds(packages, "must contain project(panvo_vision ...)", {"components/vision/CMakeLists.txt": sample.cmake_lists("panvo_sight")})

    def test_a_package_the_root_does_not_know(self):
        top = sample.TOP + "set(package_folders config/build components/vision launch_scripts)\n"
        self.assert_finds(packages, "package_folders lacks components/compass", {"CMakeLists.txt": top})

    def test_a_package_before_what_it_needs(self):
        top = sample.TOP + "set(package_folders config/build components/compass components/vision launch_scripts)\n"
        self.assert_finds(packages, "components/compass before panvo_vision", {"CMakeLists.txt": top})

    def test_a_dependency_that_package_xml_does_not_name(self):
        self.assert_finds(packages, "finds panvo_vision, which has no depend tag",
                          {"components/compass/package.xml": sample.package_xml("panvo_compass")})

    def test_a_dependency_named_twice(self):
        self.assert_finds(packages, "has <depend>panvo_vision twice",
                          {"components/compass/package.xml": sample.package_xml("panvo_compass", ["panvo_vision", "panvo_vision"])})

    def test_a_package_the_sanitizer_builds_do_not_know(self):
        self.assert_finds(packages, "config/build/tsan.meta: lacks panvo_compass", {"config/build/tsan.meta": "names:\n  panvo_vision: {}\n"})

    def test_a_library_that_setup_would_not_install(self):
        self.assert_finds(packages, "packages.txt: lacks libceres-dev",
                          {"components/vision/CMakeLists.txt": sample.cmake_lists("panvo_vision", ["Eigen3", "Ceres"])})

    def test_a_component_without_readme(self):
        self.assert_finds(packages, "components/compass: has no README.md", {"components/compass/README.md": None})

    def test_a_test_that_nobody_builds(self):
        self.assert_finds(packages, "components/vision/test/camera_test.cpp: no CMakeLists.txt of the package names it",
                          {"components/vision/test/camera_test.cpp": ""})

    def test_a_folder_of_tests_that_nobody_adds(self):
        self.assert_finds(packages, "does not list the folder faults", {
            "tests/CMakeLists.txt": "foreach(folder IN ITEMS lint)\n", "tests/faults/CMakeLists.txt": "", "tests/lint/CMakeLists.txt": ""})
