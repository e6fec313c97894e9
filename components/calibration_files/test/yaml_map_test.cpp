// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/yaml_map.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::calibration_files {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class YamlMapTest : public ::testing::Test {
 protected:
  using Read = std::function<void(YamlMap&)>;

  YamlMap load(const std::string& text) { return YamlMap(folder_.write("rig.yaml", text), "a rig file"); }

  /// The message without the folder; "accepted" without an error.
  std::string refusal(const std::function<void()>& read) const {
    try {
      read();
    } catch (const FileError& error) {
      std::string text = error.what();
      const std::string folder = folder_.path().string() + "/";
      for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder)) text.erase(at, folder.size());
      return text;
    }
    return "accepted";
  }
  /// The message of check() after reading.
  std::string refusal(const std::string& text, const Read& read) {
    return refusal([&] {
      auto map = load(text);
      read(map);
      map.check();
    });
  }
  /// The same of finish().
  std::string refusal_of_all(const std::string& text, const Read& read) {
    return refusal([&] {
      auto map = load(text);
      read(map);
      map.finish();
    });
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(YamlMapTest, ReadsValuesOfEveryKind) {
  auto map = load(R"(number: -1.5e-3
integer: 7
flag: true
text: two words
choice: six_head
size: [640., 480]
list: [1, 0.1, -3]
nested: [[1, 2], [3, 4]]
inner: {key: 5}
heads:
- {name: front}
- {name: back}
)");
  EXPECT_EQ(map.number("number", {-1.0, 1.0}), -1.5e-3);
  EXPECT_EQ(map.integer("integer", 0, 10), 7);
  EXPECT_TRUE(map.flag("flag"));
  EXPECT_EQ(map.text("text"), "two words");
  EXPECT_EQ(map.choice("choice", {"mono", "six_head"}), "six_head");
  EXPECT_THAT(map.size_px("size"), ElementsAre(640, 480));
  EXPECT_THAT(map.numbers("list", 3), ElementsAre(1.0, 0.1, -3.0));
  EXPECT_THAT(map.numbers("nested"), ElementsAre(1.0, 2.0, 3.0, 4.0));
  EXPECT_EQ(map.map("inner").integer("key", 0, 9), 5);
  auto heads = map.maps("heads");
  ASSERT_EQ(heads.size(), 2u);
  EXPECT_EQ(heads[0].text("name"), "front");
  EXPECT_EQ(heads[1].text("name"), "back");
  EXPECT_EQ(heads[1].where("name"), map.file().string() + ":12: heads[1].name");
  EXPECT_EQ(map.problems(), 0u);
  EXPECT_NO_THROW(map.finish());
}

TEST_F(YamlMapTest, ReadsOpencvsMatrices) {
  for (const char* begin : {"%YAML:1.0\n---\n", "%YAML:1.0\n\n"}) {
    auto map =
        load(std::string(begin) + "M: !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: d\n   data: [ 5., -1e-2 ]\n");
    EXPECT_THAT(map.numbers("M", 2), ElementsAre(5.0, -0.01));
    EXPECT_THAT(map.where("M"), HasSubstr("rig.yaml:3: M"));
    EXPECT_NO_THROW(map.finish());
  }
}

TEST_F(YamlMapTest, BearsAliasesThatBlowUpAList) {
  const auto read = [](YamlMap& map) { map.numbers("list"); };
  const std::string refused = ": list must be a list of numbers, or a matrix (rows, cols, data)";
  EXPECT_EQ(refusal("row: &r [1, 2]\nlist: [*r, *r]\n", read), "accepted");
  EXPECT_EQ(refusal("list: &again [1, *again]\n", read), "rig.yaml:1" + refused);
  EXPECT_EQ(refusal("list: &again {data: *again}\n", read), "rig.yaml:1" + refused);
  std::string twice = "a0: &a0 [1, 2]\n";  // each list is twice the one before: 2^64 numbers
  for (int i = 1; i < 64; ++i) twice += fmt::format("a{0}: &a{0} [*a{1}, *a{1}]\n", i, i - 1);
  EXPECT_EQ(refusal(twice + "list: *a63\n", read), "rig.yaml:65" + refused);
  std::string row = "row: &r [1";
  for (int i = 1; i < 200; ++i) row += ", 1";
  std::string rows = "]\nlist: [*r";
  for (int i = 1; i < 200; ++i) rows += ", *r";
  EXPECT_EQ(refusal(row + rows + "]\n", read), "rig.yaml:2" + refused);
}

TEST_F(YamlMapTest, GivesDefaultsForWhatIsMissing) {
  auto map = load("name: ''\nframe:\n");
  EXPECT_EQ(map.number("a", {0.0, 1.0}, 6.0), 6.0);
  EXPECT_EQ(map.integer("b", 0, 1, 3), 3);
  EXPECT_TRUE(map.flag("c", true));
  EXPECT_EQ(map.choice("d", {"x"}, "y"), "y");
  EXPECT_EQ(map.text("name", "head_0"), "head_0");
  EXPECT_EQ(map.text("frame", "top"), "top");
  EXPECT_EQ(map.map("panorama").number("blend_deg", {}, 2.0), 2.0);
  EXPECT_FALSE(map.has("panorama"));
  EXPECT_NO_THROW(map.finish());
}

TEST_F(YamlMapTest, SaysWhyAFileCannotBeRead) {
  const auto read = [&](const std::string& name) { return refusal([&] { YamlMap(folder_ / name, "a rig file"); }); };
  EXPECT_EQ(read("no.yaml"), "no.yaml: cannot be opened; check that it exists and is readable; expected a rig file");
  std::filesystem::create_directory(folder_ / "folder");
  EXPECT_EQ(read("folder"), "folder: is a folder; expected a rig file");
  const auto loaded = [&](const std::string& text) { return refusal(text, [](YamlMap&) {}); };
  EXPECT_EQ(loaded(" \n"), "rig.yaml: is empty; expected a rig file");
  EXPECT_EQ(loaded("- a\n- b\n"), "rig.yaml: contains no `key: value` lines; expected a rig file");
  EXPECT_EQ(loaded("# only this\n"), "rig.yaml: contains no `key: value` lines; expected a rig file");
  EXPECT_THAT(loaded("a: 1\nb: [1, 2\nc: }\n"),
              AllOf(StartsWith("rig.yaml:3: is not YAML: "), HasSubstr("check indentation"), HasSubstr("a rig file")));
}

TEST_F(YamlMapTest, SaysWhatIsWrongWithAValue) {
  const auto value = [&](const std::string& written, const Read& read) { return refusal("\nkey: " + written, read); };
  EXPECT_EQ(value("wide",
                  [](YamlMap& map) {
                    map.number("key", {0.0, 90.0, "degrees"});
                  }),
            "rig.yaml:2: key must be a number from 0 to 90 degrees, not 'wide'");
  EXPECT_EQ(value("91",
                  [](YamlMap& map) {
                    map.number("key", {0.0, 90.0, "degrees"}, 1.0);
                  }),
            "rig.yaml:2: key must be a number from 0 to 90 degrees, not '91'");
  EXPECT_THAT(value(".nan", [](YamlMap& map) { map.number("key", {}); }), HasSubstr("not '.nan'"));
  EXPECT_EQ(value("7.5", [](YamlMap& map) { map.integer("key", 0, 10); }),
            "rig.yaml:2: key must be a whole number from 0 to 10, not '7.5'");
  EXPECT_EQ(value("maybe", [](YamlMap& map) { map.flag("key"); }),
            "rig.yaml:2: key must be true or false, not 'maybe'");
  EXPECT_EQ(value("''", [](YamlMap& map) { map.text("key"); }), "rig.yaml:2: key must be a non-empty string, not ''");
  EXPECT_EQ(value("[a]", [](YamlMap& map) { map.text("key", "b"); }), "rig.yaml:2: key must be a non-empty string");
  EXPECT_EQ(value("eight",
                  [](YamlMap& map) {
                    map.choice("key", {"one", "two"});
                  }),
            "rig.yaml:2: key must be one of one, two, not 'eight'");
  for (const char* wrong : {"[640, 0]", "[640, 480.5]", "[640]", "[640, high]"})
    EXPECT_EQ(value(wrong, [](YamlMap& map) { map.size_px("key", 16, 8192); }),
              "rig.yaml:2: key must be [width, height], whole numbers from 16 to 8192 px");
  EXPECT_EQ(value("640", [](YamlMap& map) { map.size_px("key"); }),
            "rig.yaml:2: key must be [width, height], whole numbers from 1 to 65536 px, not '640'");
}

TEST_F(YamlMapTest, SaysWhatIsWrongWithAList) {
  const auto list = [&](const std::string& written) {
    return refusal("key: " + written, [](YamlMap& map) { map.numbers("key", 2, {-10.0, 10.0, "m"}); });
  };
  for (const char* wrong : {"[1, two]", "1", "{rows: 1}", "{data: 3}", "[1, {a: 2}]", ""})
    EXPECT_EQ(list(wrong), "rig.yaml:1: key must be a list of 2 numbers, or a matrix (rows, cols, data)") << wrong;
  EXPECT_EQ(list("[1, 2, 3]"), "rig.yaml:1: key must be a list of 2 numbers, not of 3");
  EXPECT_EQ(list("[1, 11]"), "rig.yaml:1: key must be a list of 2 numbers from -10 to 10 m, not 11");
  EXPECT_EQ(list("[1, .nan]"), "rig.yaml:1: key must be a list of 2 numbers from -10 to 10 m, not nan");
  EXPECT_EQ(refusal("key: [a]", [](YamlMap& map) { map.numbers("key"); }),
            "rig.yaml:1: key must be a list of numbers, or a matrix (rows, cols, data)");
}

TEST_F(YamlMapTest, SaysThatARequiredKeyIsMissing) {
  const std::vector<Read> readers{
      [](YamlMap& map) { map.number("key", {}); }, [](YamlMap& map) { map.integer("key", 0, 1); },
      [](YamlMap& map) { map.flag("key"); },       [](YamlMap& map) { map.text("key"); },
      [](YamlMap& map) { map.choice("key", {}); }, [](YamlMap& map) { map.numbers("key", 3); },
      [](YamlMap& map) { map.size_px("key"); },    [](YamlMap& map) { map.maps("key"); }};
  for (const auto& read : readers) EXPECT_EQ(refusal("\nother: 1\n", read), "rig.yaml:2: key is missing; add it");
  EXPECT_EQ(refusal("stereo:\n  other: 1\n", [](YamlMap& map) { map.map("stereo").text("key"); }),
            "rig.yaml:1: stereo.key is missing; add it");
}

TEST_F(YamlMapTest, GivesZerosUntilAProblemIsThrown) {
  auto map = load("size: 3\nlist: [1]\n");
  EXPECT_THAT(map.numbers("list", 2), ElementsAre(0.0, 0.0));
  EXPECT_THAT(map.size_px("size"), ElementsAre(0, 0));
  EXPECT_EQ(map.integer("none", 1, 2), 0);
  EXPECT_THAT(map.maps("heads"), IsEmpty());
  EXPECT_EQ(map.problems(), 4u);
}

TEST_F(YamlMapTest, SaysWhatIsNotAMapWithoutCallingItsKeysMissing) {
  EXPECT_EQ(refusal("stereo: 3\n", [](YamlMap& map) { map.map("stereo").number("rate_hz", {}); }),
            "rig.yaml:1: stereo must be a map of `key: value` lines");
  EXPECT_EQ(refusal("heads:\n- {name: a}\n- b\n",
                    [](YamlMap& map) {
                      for (auto& head : map.maps("heads")) head.text("name");
                    }),
            "rig.yaml:3: heads[1] must be a map of `key: value` lines");
  for (const char* wrong : {"[]", "3"})
    EXPECT_EQ(refusal(std::string("heads: ") + wrong, [](YamlMap& map) { map.maps("heads"); }),
              "rig.yaml:1: heads must be a list of at least one map: lines that begin with `- `");
}

TEST_F(YamlMapTest, ListsAllProblemsInTheOrderOfTheFile) {
  const auto text = refusal_of_all("stereo:\n  rate_hz: fast\n  baseline_mm: 1\npanorma: {}\nheads:\n- {image: -1}\n",
                                   [](YamlMap& map) {
                                     for (auto& head : map.maps("heads")) head.integer("image", 0, 5);
                                     auto stereo = map.map("stereo");
                                     stereo.number("baseline_m", {0.005, 5.0, "m"}, 0.12);
                                     stereo.number("rate_hz", {0.1, 1000.0, "Hz"}, 25.0);
                                     map.map("panorama").flag("colour", false);
                                   });
  EXPECT_EQ(text,
            "rig.yaml:2: stereo.rate_hz must be a number from 0.1 to 1000 Hz, not 'fast'\n"
            "rig.yaml:3: stereo.baseline_mm is not a known key; did you mean baseline_m? Known keys: baseline_m, "
            "rate_hz\n"
            "rig.yaml:4: panorma is not a known key; did you mean panorama? Known keys: heads, panorama, stereo\n"
            "rig.yaml:6: heads[0].image must be a whole number from 0 to 5, not '-1'");
}

TEST_F(YamlMapTest, SuggestsOnlyAKeyThatIsNear) {
  EXPECT_EQ(refusal_of_all("colour: true\n", [](YamlMap& map) { map.number("rate_hz", {}, 1.0); }),
            "rig.yaml:1: colour is not a known key; known keys: rate_hz");
  EXPECT_EQ(refusal_of_all("rate: 2\n", [](YamlMap& map) { map.number("rate_hz", {}, 1.0); }),
            "rig.yaml:1: rate is not a known key; did you mean rate_hz? Known keys: rate_hz");
  EXPECT_EQ(refusal_of_all("colour: true\n", [](YamlMap&) {}), "rig.yaml:1: colour is not a known key; remove it");
}

TEST_F(YamlMapTest, PermitsOtherKeysWithCheck) {
  EXPECT_EQ(refusal("a: 1\nb: 2\n", [](YamlMap& map) { map.has("a"); }), "accepted");
}

TEST_F(YamlMapTest, RefusesAKeyThatIsGivenTwice) {
  EXPECT_EQ(refusal("a: 1\nin:\n  b: 1\n  b: 2\na: 3\n", [](YamlMap& map) { map.map("in"); }),
            "rig.yaml:4: in.b is given twice; remove one of them\nrig.yaml:5: a is given twice; remove one of them");
}

TEST_F(YamlMapTest, TakesProblemsOfItsReaderAndOfOtherFiles) {
  const auto text = refusal("a: 1\nlens: lens.yaml\n", [](YamlMap& map) {
    for (int i = 0; i < 2; ++i) map.include("lens", FileError("lens.yaml:7: camera_matrix is missing; add it"));
    map.reject("a", "must be even; add 1");
  });
  EXPECT_EQ(text, "rig.yaml:1: a must be even; add 1\nlens.yaml:7: camera_matrix is missing; add it");
}

}  // namespace
}  // namespace panvo::calibration_files
