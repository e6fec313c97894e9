# SPDX-License-Identifier: Apache-2.0
import sample
import unity

L = sample.LICENCE
TARGETS = sample.cmake_lists("panvo_compass", ["panvo_vision"]) + "panvo_add_library(panvo_compass\n  SOURCES src/a.cpp src/b.cpp)\n"


def internal(function):
    return f"{L}namespace panvo {{\nnamespace {{\n\n{function}\n\n}}  // namespace\n}}  // namespace panvo\n"


class UnityTest(sample.RuleTest):
    def workspace(self, one, other, lists=TARGETS):
        return {"components/compass/CMakeLists.txt": lists, "components/compass/src/a.cpp": internal(one), "components/compass/src/b.cpp": internal(other)}

    def test_overloads_in_two_sources_of_a_library_are_found(self):
        self.assert_finds(unity, "components/compass/src/b.cpp: the internal name turn is that of one in components/compass/src/a.cpp",
                          self.workspace("double turn(double by) { return by; }", "float turn(const Pose& pose, float by) {\n  return by;\n}"))

    def test_other_names_calls_and_other_targets_are_not(self):
        self.assertEqual(self.complaints(unity, self.workspace("double turn(double by) { return by; }", "double back() {\n  return turn(1.0);\n}")), [])
        apart = TARGETS.replace(" src/b.cpp", "") + "panvo_add_executable(b SOURCES src/b.cpp)\n"
        self.assertEqual(self.complaints(unity, self.workspace("double turn(double by) { return by; }", "float turn(float by) { return by; }", apart)), [])

    def test_an_overload_of_a_function_of_a_header_is_found(self):
        files = self.workspace("double turn(double by, double at = 0.0) { return by + at; }", "float back() { return 0.0f; }")
        header = {"components/compass/src/turn.hpp": L + "#pragma once\n\nfloat turn(float by);\n"}
        self.assert_finds(unity, "a.cpp: the internal name turn is that of one in components/compass/src/turn.hpp", {**files, **header})
