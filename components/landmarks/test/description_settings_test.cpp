// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/description_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace panvo::landmarks {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct SomeParameters {
  int band_rows = 150;
  double band_top_deg = 35.1;
  bool mirrored = false;
  std::string kind = "acf";

  template <class Field>
  static void describe(Field&& field) {
    using P = SomeParameters;
    field(&P::band_rows, "band_rows", "px", "rows", 1, 1000);
    field(&P::band_top_deg, "band_top_deg", "deg", "elevation of the upper edge", 0.0, 90.0);
    field(&P::mirrored, "mirrored", "", "left and right exchanged");
    field(&P::kind, "kind", "", "of features", {"acf", "cf"});
  }
};

TEST(DescriptionSettings, HoldEveryParameterAndTheSeed) {
  const DescriptionSettings expected{
      {"band_rows", "150"}, {"band_top_deg", "35.1"}, {"kind", "acf"}, {"mirrored", "false"}, {"seed", "7"}};
  EXPECT_EQ(description_settings(SomeParameters{}, 7), expected);
}

TEST(DescriptionSettings, TellNumbersApartThatDifferInTheLastBit) {
  EXPECT_NE(settings_text(0.1), settings_text(0.1 + 2e-17));
  EXPECT_EQ(settings_text(0.1), "0.1");
  EXPECT_EQ(settings_text(std::uint64_t{18446744073709551615u}), "18446744073709551615");
}

TEST(DescriptionSettings, GiveTheParametersBack) {
  SomeParameters parameters;
  parameters.band_top_deg = 1.0 / 3.0;
  parameters.mirrored = true;
  const auto settings = description_settings(parameters, 7);
  const auto read = from_settings<SomeParameters>(settings);
  ASSERT_TRUE(read);
  EXPECT_EQ(description_settings(read->first, read->second), settings);

  for (const auto& [key, value] : settings) {
    auto changed = settings;
    changed.erase(key);
    EXPECT_FALSE(from_settings<SomeParameters>(changed)) << key;
  }
  auto changed = settings;
  changed["band_rows"] = "150x";
  EXPECT_FALSE(from_settings<SomeParameters>(changed));
}

TEST(DescriptionSettings, DifferByKeyWithBothValues) {
  EXPECT_THAT(differences({{"a", "1"}, {"b", "2"}, {"c", "3"}}, {{"b", "2"}, {"c", "4"}, {"d", "5"}}),
              ElementsAre("a is 1 there, not set here", "c is 3 there, 4 here", "d is not set there, 5 here"));
  EXPECT_THAT(differences({{"a", "1"}}, {{"a", "1"}}), IsEmpty());
}

TEST(DescriptionSettings, ComeBackFromText) {
  const DescriptionSettings settings{{"a", "1"}, {"empty", ""}, {"equation", "x=y"}};
  EXPECT_EQ(to_text(settings), "a=1\nempty=\nequation=x=y\n");
  EXPECT_EQ(settings_from_text(to_text(settings)), settings);
  EXPECT_THAT(settings_from_text(""), IsEmpty());
  EXPECT_EQ(settings_from_text("a\n\nb=2"), (DescriptionSettings{{"a", ""}, {"b", "2"}}));
}

}  // namespace
}  // namespace panvo::landmarks
