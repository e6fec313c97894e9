# SPDX-License-Identifier: Apache-2.0
"""The layouts for Foxglove, Lichtblick and RViz: they show topics and members that exist, where one can see them."""
import json
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAYOUT = ROOT / "config/views/panvo.foxglove.json"
RVIZ_LAYOUT = ROOT / "config/views/panvo.rviz"
TOPIC = re.compile(r'Topic<(\w+)::msg::(\w+)>\s+k\w+\{\s*"/?([^"]+)"')


def known_topics():
    """Message type by topic, from the headers that name them."""
    headers = (ROOT / "interfaces/include/panvo/interfaces").glob("*topics.hpp")
    return {"/" + name: f"{package}/msg/{kind}" for header in headers
            for package, kind, name in TOPIC.findall(header.read_text(encoding="utf-8"))}


class FoxgloveLayout(unittest.TestCase):
    def setUp(self):
        self.panels = json.loads(LAYOUT.read_text(encoding="utf-8"))["configById"]
        self.topics = known_topics()

    def plotted(self):
        return [(panel, path) for panel, config in self.panels.items() for path in config.get("paths", [])]

    def test_plotted_members_exist(self):
        self.assertGreater(len(self.plotted()), 5)
        for panel, path in self.plotted():
            topic, member = path["value"].split(".")
            self.assertIn(topic, self.topics, panel)
            definition = (ROOT / "interfaces/idl" / f"{self.topics[topic]}.idl").read_text(encoding="utf-8")
            self.assertRegex(definition, rf"\b{member};", panel)

    def test_shown_topics_exist(self):
        for panel, config in self.panels.items():
            shown = [*config.get("topics", {}), config.get("imageMode", {}).get("imageTopic"), config.get("topicToRender")]
            for topic in filter(None, shown):
                # Markers are a component's own topic.
                self.assertTrue(topic in self.topics or topic == "/places/markers", f"{panel}: {topic}")

    def test_values_lie_at_the_time_of_the_viewer(self):
        # In a bag of a played recording, the stamps in the headers are those of the drive, often years before the bag.
        for panel, path in self.plotted():
            self.assertEqual(path["timestampMethod"], "receiveTime", f"{panel}: {path['value']}")

    def test_plots_have_titles_in_both_viewers(self):
        for panel, config in self.panels.items():
            if panel.startswith("Plot!"):
                self.assertTrue(config.get("foxglovePanelTitle"), panel)
                self.assertEqual(config.get("lichtblickPanelTitle"), config["foxglovePanelTitle"], panel)

    def test_each_panel_is_placed_once(self):
        def leaves(node):
            return [node] if isinstance(node, str) else [*leaves(node["first"]), *leaves(node["second"])]
        layout = json.loads(LAYOUT.read_text(encoding="utf-8"))["layout"]
        self.assertEqual(sorted(leaves(layout)), sorted(self.panels))


class RVizLayout(unittest.TestCase):
    TYPES = {"Path": "nav_msgs/msg/Path", "Odometry": "nav_msgs/msg/Odometry", "Image": "sensor_msgs/msg/Image",
             "PointCloud2": "sensor_msgs/msg/PointCloud2", "MarkerArray": "visualization_msgs/msg/MarkerArray"}

    def setUp(self):
        self.text = RVIZ_LAYOUT.read_text(encoding="utf-8")

    def value(self, key):
        found = re.search(rf"^\s*{re.escape(key)}: (.*)$", self.text, re.MULTILINE)
        self.assertIsNotNone(found, key)
        return found[1]

    def test_displays_read_topics_of_their_types(self):
        shown = re.findall(r"- Class: rviz_default_plugins/(\w+)\n(?: {6}.*\n)*? {6}Topic: \{Value: (\S+),", self.text)
        self.assertGreater(len(shown), 5)
        topics = {**known_topics(), "/places/markers": "visualization_msgs/msg/MarkerArray"}
        for kind, topic in shown:
            self.assertEqual(topics.get(topic), self.TYPES[kind], topic)

    def test_panels_leave_room_for_the_map(self):
        # Without the places of the panels, RViz stacks them until nothing is left of the map and of the images; without
        # the two switches, it hides them or not as memory happens to be.
        self.assertGreaterEqual(int(self.value("Width")), 1200)
        self.assertEqual((self.value("Hide Left Dock"), self.value("Hide Right Dock")), ("false", "false"))
        digits = re.search(r'QMainWindow State: "([^"]*)"', self.text)[1]
        state = bytes.fromhex(re.sub(r"[\\\s]", "", digits))
        panels = re.findall(r"Class: rviz_common/\w+, Name: (\w+)", self.text)
        images = re.findall(r"- Class: rviz_default_plugins/Image\n +Name: (.*)", self.text)
        self.assertGreater(len(panels) + len(images), 3)
        for name in panels + images:
            self.assertIn(name.encode("utf-16-be"), state, name)  # as Qt stores it

    def test_points_have_the_colour_of_their_state(self):
        # In RViz's inverted rainbow, blue lies at 20 %, green at 60 %, red at 100 %.
        lowest, highest = float(self.value("Min Intensity")), float(self.value("Max Intensity"))
        self.assertEqual(self.value("Invert Rainbow"), "true")
        new, follows, contradicts = ((state - lowest) / (highest - lowest) for state in (0, 1, 2))
        self.assertAlmostEqual(new, 0.2)
        self.assertAlmostEqual(follows, 0.6)
        self.assertAlmostEqual(contradicts, 1.0)


if __name__ == "__main__":
    unittest.main()
