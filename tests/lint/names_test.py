# SPDX-License-Identifier: Apache-2.0
import names
import sample

L = sample.LICENCE
GOOD = L + """#pragma once
#define PANVO_MAGIC 1
namespace panvo::vision {
constexpr int kMax = 3;
inline constexpr double kMargin_px = 2.0;
enum class Kind { kFirst };
class PoseGraph : public Base {
 public:
  explicit PoseGraph(int size_px);
  int rows = 0;

 private:
  int add_pose(int x);
  std::vector<int> poses_;
  std::map<int, std::string> names_{};
  static constexpr int kDepth = 2;
};
struct Plain {
  int width;
};
int add_pose(int count) { return count; }
PoseGraph::PoseGraph(int size_px) {}
}  // namespace panvo::vision
"""


class NamesTest(sample.RuleTest):
    def with_change(self, old, new):
        self.assertIn(old, GOOD)
        return {"components/vision/src/a.hpp": GOOD.replace(old, new)}

    def test_a_whole_workspace_breaks_nothing(self):
        self.assertEqual(self.complaints(names, {"components/vision/src/a.hpp": GOOD}), [])

    def test_a_file_in_another_case(self):
        self.assert_finds(names, "PoseGraph.hpp:1: files are snake_case", {"components/vision/src/PoseGraph.hpp": GOOD})

    def test_a_type_in_another_case(self):
        self.assert_finds(names, "a.hpp:8: pose_graph: types", self.with_change("class PoseGraph :", "class pose_graph :"))
        self.assert_finds(names, "kind: types", self.with_change("enum class Kind", "enum class kind"))

    def test_a_constant_without_its_k(self):
        self.assert_finds(names, "a.hpp:5: largest: constants", self.with_change("kMax", "largest"))
        self.assert_finds(names, "kdepth: constants", self.with_change("kDepth", "kdepth"))

    def test_a_function_in_another_case(self):
        self.assert_finds(names, "a.hpp:22: addPose: functions", self.with_change("int add_pose(int count)", "int addPose(int count)"))

    def test_a_private_member_without_its_underscore(self):
        self.assert_finds(names, "a.hpp:15: poses: private members", self.with_change("poses_;", "poses;"))
        self.assert_finds(names, "names: private members", self.with_change("names_{}", "names{}"))

    def test_a_macro_in_small_letters(self):
        self.assert_finds(names, "panvo_magic: macros", self.with_change("PANVO_MAGIC", "panvo_magic"))
