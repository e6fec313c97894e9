# SPDX-License-Identifier: Apache-2.0
"""The layout for Foxglove and Lichtblick: it shows topics and members that exist, at times that fit a recording."""
import json
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAYOUT = ROOT / "config/views/panvo.foxglove.json"
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


if __name__ == "__main__":
    unittest.main()
