// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <limits>

namespace panvo::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Tracker {
  int max_features = 400;
  float search_radius_px = 10.0F;

  template <class Field>
  static void describe(Field&& field) {
    field(&Tracker::max_features, "max_features", "1", "features kept a frame", 50, 5000);
    field(&Tracker::search_radius_px, "search_radius", "px", "how far a feature may move", 0.5, 100);
  }
};

struct Odometry {
  std::string front_end = "klt";
  bool subpixel = true;
  double gain = 0.5;
  std::string note;
  std::vector<double> weights{1, 2};
  std::vector<std::string> layers;
  Tracker tracker;

  template <class Field>
  static void describe(Field&& field) {
    field(&Odometry::front_end, "front_end", "", "feature front end", {"klt", "sift"});
    field(&Odometry::subpixel, "subpixel", "", "refine corners to sub-pixel");
    field(&Odometry::gain, "gain", "1", "gain", 0, 1);
    field(&Odometry::note, "note", "", "free text");
    field(&Odometry::weights, "weights", "1", "weights of the layers");
    field(&Odometry::layers, "layers", "", "names of the layers");
    field.group(&Odometry::tracker, "tracker");
  }
};

WrittenValue written(const std::string& text, int line = 1) { return {{text}, false, {"stereo.yaml", line}}; }
WrittenValue written_list(std::vector<std::string> items, int line = 1) {
  return {std::move(items), true, {"stereo.yaml", line}};
}

template <class Value>
std::string wrong(const std::string& text) {
  Value value{};
  return parse(written(text), value).value_or("");
}

TEST(Parse, TakesTheWholeValueOrNothing) {
  std::int64_t whole = 3;
  EXPECT_EQ(parse(written("12x"), whole), "is not a whole number");
  EXPECT_EQ(whole, 3);
  EXPECT_EQ(wrong<std::int64_t>(" 12"), "is not a whole number");
  EXPECT_EQ(wrong<std::int64_t>(""), "is not a whole number");
  EXPECT_EQ(wrong<double>("1.5 "), "is not a number");
  EXPECT_EQ(wrong<double>("1,5"), "is not a number");
  EXPECT_EQ(wrong<double>("+-1"), "is not a number");
  EXPECT_EQ(wrong<bool>("yes"), "is not true or false");
  EXPECT_EQ(wrong<bool>("1"), "is not true or false");
}

TEST(Parse, RefusesWhatIsNotFinite) {
  EXPECT_EQ(wrong<double>("nan"), "is not a finite number");
  EXPECT_EQ(wrong<double>("-inf"), "is not a finite number");
  EXPECT_EQ(wrong<double>(".nan"), "is not a number");
  EXPECT_EQ(wrong<double>("1e400"), "is a number out of range");
  EXPECT_EQ(wrong<std::int64_t>("9223372036854775808"), "is a whole number out of range");
}

TEST(Parse, TakesWholeNumbersAsNumbersButNotNumbersAsWholeNumbers) {
  double number = 0;
  EXPECT_EQ(parse(written("7"), number), std::nullopt);
  EXPECT_EQ(number, 7.0);
  EXPECT_EQ(parse(written("+2.5e-3"), number), std::nullopt);
  EXPECT_EQ(number, 2.5e-3);
  EXPECT_EQ(wrong<std::int64_t>("7.0"), "is not a whole number");
  EXPECT_EQ(wrong<std::int64_t>("1e3"), "is not a whole number");
}

TEST(Parse, TellsListsFromSingleValues) {
  double number = 0;
  EXPECT_EQ(parse(written_list({"1"}), number), "is a list, but one value is needed");
  std::vector<double> numbers{9};
  EXPECT_EQ(parse(written("1"), numbers), "is not a list; write [1.0, 2.0]");
  EXPECT_EQ(parse(written_list({"1", "x"}), numbers), "item 2, x, is not a number");
  EXPECT_EQ(numbers, std::vector<double>{9});
  EXPECT_EQ(parse(written_list({"1", "-2.5"}), numbers), std::nullopt);
  EXPECT_THAT(numbers, ElementsAre(1.0, -2.5));
}

TEST(Parse, GivesBackWhatWasMadeText) {
  for (const double value : {0.1, -0.0, 1e-308, 123456789.987654321, std::numeric_limits<double>::max()}) {
    double back = 1;
    ASSERT_EQ(parse(written(to_text(value)), back), std::nullopt);
    EXPECT_EQ(back, value);
  }
  for (const std::int64_t value : {std::numeric_limits<std::int64_t>::min(), std::int64_t{0}}) {
    std::int64_t back = 1;
    ASSERT_EQ(parse(written(to_text(value)), back), std::nullopt);
    EXPECT_EQ(back, value);
  }
  EXPECT_EQ(to_text(true), "true");
  EXPECT_EQ(to_text(std::vector<double>{1, 2.5}), "[1, 2.5]");
}

TEST(Parse, KnowsNoLocale) {
  const char* german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  double number = 0;
  EXPECT_EQ(parse(written("1.5"), number), std::nullopt);
  EXPECT_EQ(number, 1.5);
  EXPECT_EQ(to_text(1.5), "1.5");
  std::setlocale(LC_ALL, "C");
  if (german == nullptr) {
    GTEST_SKIP() << "the locale de_DE.UTF-8 is not installed: tried in the C locale only";
  }
}

TEST(ParameterReader, OverridesDefaultsByWhatIsWritten) {
  ParameterReader reader("odometry", {{"front_end", written("sift")},
                                      {"subpixel", written("false")},
                                      {"gain", written("1")},
                                      {"note", written("")},
                                      {"weights", written_list({"3"})},
                                      {"layers", written_list({"a", "b"})},
                                      {"tracker.max_features", written("5000")},
                                      {"tracker.search_radius", written("0.5")}});
  const auto parameters = reader.read<Odometry>();
  EXPECT_EQ(parameters.front_end, "sift");
  EXPECT_FALSE(parameters.subpixel);
  EXPECT_EQ(parameters.gain, 1.0);
  EXPECT_EQ(parameters.note, "");
  EXPECT_THAT(parameters.weights, ElementsAre(3.0));
  EXPECT_THAT(parameters.layers, ElementsAre("a", "b"));
  EXPECT_EQ(parameters.tracker.max_features, 5000);
  EXPECT_EQ(parameters.tracker.search_radius_px, 0.5F);
  EXPECT_TRUE(reader.problems().empty());
}

struct Window {
  int fixed = 3, all = 10;

  template <class Field>
  static void describe(Field&& field) {
    field(&Window::fixed, "fixed", "1", "of all", 1, 49);
    field(&Window::all, "all", "1", "adjusted together", 2, 50);
  }
  template <class Conflict>
  void find_conflicts(Conflict&& conflict) const {
    if (fixed >= all) conflict("fixed", "must be less than", "all");
  }
};

struct Motion {
  Window window;

  template <class Field>
  static void describe(Field&& field) {
    field.group(&Motion::window, "window");
  }
};

TEST(ParameterReader, NamesBothOfTwoThatContradictEachOther) {
  ParameterReader reader("odometry", {{"window.fixed", written("20")}});
  reader.read<Motion>();
  ASSERT_EQ(reader.problems().size(), 1U);
  EXPECT_THAT(reader.problems()[0], HasSubstr("odometry.window.fixed (20) must be less than window.all (10)"));
  ParameterReader of_defaults("odometry", {});
  of_defaults.read<Motion>();
  EXPECT_TRUE(of_defaults.problems().empty());
}

TEST(ParameterReader, DescribesWhatWasDeclaredOnce) {
  ParameterReader reader("odometry", {{"tracker.max_features", written("500")}});
  reader.read<Odometry>();
  reader.read<Odometry>();
  ASSERT_EQ(reader.declared().size(), 8U);
  const auto& front_end = reader.declared()[0];
  EXPECT_EQ(front_end.type, "text");
  EXPECT_THAT(front_end.choices, ElementsAre("klt", "sift"));
  const auto& features = reader.declared()[6];
  EXPECT_EQ(features.name, "tracker.max_features");
  EXPECT_EQ(features.type, "integer");
  EXPECT_EQ(features.unit, "1");
  EXPECT_EQ(features.description, "features kept a frame");
  EXPECT_EQ(features.default_value, "400");
  EXPECT_EQ(features.value, "500");
  EXPECT_EQ(features.min, 50);
  EXPECT_EQ(features.max, 5000);
}

TEST(ParameterReader, ListsEveryProblemInOrderOfLineAndKeepsTheDefaults) {
  ParameterReader reader("binocular_odometry", {{"front_end", written("orb", 30)},
                                                {"gain", written("high", 12)},
                                                {"max_feature", written("7", 18)},
                                                {"subpixel", written("maybe", 9)},
                                                {"tracker.max_features", written("7", 17)},
                                                {"tracker.search_radius", written("0.4", 20)}});
  const auto parameters = reader.read<Odometry>();
  EXPECT_EQ(parameters.front_end, "klt");
  EXPECT_EQ(parameters.tracker.max_features, 400);
  EXPECT_THAT(reader.problems(),
              ElementsAre("stereo.yaml:9: binocular_odometry.subpixel = maybe: is not true or false (refine corners "
                          "to sub-pixel)",
                          "stereo.yaml:12: binocular_odometry.gain = high: is not a number; must be 0..1 (gain)",
                          "stereo.yaml:17: binocular_odometry.tracker.max_features = 7: must be 50..5000 (features "
                          "kept a frame)",
                          "stereo.yaml:18: binocular_odometry has no parameter \"max_feature\"; did you mean "
                          "\"tracker.max_features\"?",
                          "stereo.yaml:20: binocular_odometry.tracker.search_radius = 0.4: must be 0.5..100 px (how "
                          "far a feature "
                          "may move)",
                          "stereo.yaml:30: binocular_odometry.front_end = orb: must be one of klt, sift (feature "
                          "front end)"));
}

TEST(ParameterReader, AcceptsTheEndsOfARangeAndNothingBeyond) {
  for (const auto& [text, good] : std::map<std::string, bool>{
           {"50", true}, {"5000", true}, {"49", false}, {"5001", false}, {"4294967346", false}}) {  // 50 in 32 bits
    ParameterReader reader("odometry", {{"tracker.max_features", written(text)}});
    reader.read<Odometry>();
    EXPECT_EQ(reader.problems().empty(), good) << text;
  }
}

TEST(ParameterReader, NamesAllParametersWhenNoneIsNear) {
  ParameterReader reader("tracker", {{"colour", written("red")}});
  reader.read<Tracker>();
  EXPECT_THAT(reader.problems(), ElementsAre("stereo.yaml:1: tracker has no parameter \"colour\"; known names: "
                                             "max_features, search_radius"));
}

TEST(ParameterReader, ComplainsOfAnyValueToAComponentWithoutParameters) {
  ParameterReader reader("rectifier", {{"gain", {{"1"}, false, {"--set", 0}}}});
  EXPECT_THAT(reader.problems(), ElementsAre("--set: rectifier has no parameter \"gain\"; there are none"));
}

TEST(ParameterReader, LeavesAValueForSeveralNodesToThoseThatHaveItsParameter) {
  WrittenValue wrong = written("red"), unknown = written("red", 2);
  wrong.is_for_several = unknown.is_for_several = true;
  ParameterReader reader("tracker", {{"max_features", wrong}, {"colour", unknown}});
  reader.read<Tracker>();
  EXPECT_THAT(reader.problems(), ElementsAre(HasSubstr("stereo.yaml:1: tracker.max_features = red")));
}

TEST(ConfigError, SaysEveryProblemOnALineOfItsOwn) {
  const ConfigError error(std::vector<std::string>{"a.yaml:1: one", "a.yaml:2: two"});
  EXPECT_STREQ(error.what(), "a.yaml:1: one\na.yaml:2: two");
  EXPECT_THAT(error.problems(), ElementsAre("a.yaml:1: one", "a.yaml:2: two"));
}

struct Store {
  std::string file = "the default";
  std::string note;

  template <class Field>
  static void describe(Field&& field) {
    field.path(&Store::file, "file", "the store");
    field(&Store::note, "note", "", "free text");
  }
};

TEST(ParameterReader, TakesNoPathsButThoseBelowTheFolderItIsConfinedTo) {
  const WrittenValues values{{"file", written("/etc/passwd")}, {"note", written("/etc/passwd")}};
  ParameterReader free("landmark_store", values);
  EXPECT_EQ(free.read<Store>().file, "/etc/passwd");
  EXPECT_TRUE(free.declared()[0].is_path);
  EXPECT_FALSE(free.declared()[1].is_path);

  ParameterReader confined("landmark_store", values);
  confined.confine_paths("");
  EXPECT_EQ(confined.read<Store>().file, "the default") << "so that nobody opens it meanwhile";
  EXPECT_EQ(confined.read<Store>().note, "/etc/passwd");
  ASSERT_FALSE(confined.problems().empty());
  EXPECT_THAT(confined.problems().front(), testing::HasSubstr("landmark_store.file = /etc/passwd"));

  ParameterReader elsewhere("landmark_store", values);
  elsewhere.confine_paths("/etc");
  EXPECT_EQ(elsewhere.read<Store>().file, "/etc/passwd");
}

}  // namespace
}  // namespace panvo::runtime
