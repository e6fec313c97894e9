// SPDX-License-Identifier: Apache-2.0
// Setting parameters of a running component.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <thread>

#include "context_state.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Tunable final : public Component {
 public:
  struct Gains {
    double gain = 0.5;
    std::string mode = "fast";
    std::string file;
    template <class Field>
    static void describe(Field&& field) {
      field(&Gains::gain, "gain", "1", "of the test", 0.0, 1.0);
      field(&Gains::mode, "mode", "", "of the test", {"fast", "exact"});
      field.path(&Gains::file, "file", "of the test");
    }
  };
  struct Sizes {
    std::int64_t size = 3;
    template <class Field>
    static void describe(Field&& field) {
      field(&Sizes::size, "size", "px", "fixed", 1, 9);
    }
  };

  explicit Tunable(Context& context) : gains(context.parameters<Gains>()), sizes(context.parameters<Sizes>()) {
    last = this;
    state = &context.state();
    context.on_parameters<Gains>([this](const Gains& wanted) {
      if (wanted.gain == 1.0) throw ConfigError("a gain of 1 does not go with this camera");
      taken_by = std::this_thread::get_id();
      gains = wanted;
    });
  }

  Gains gains;
  Sizes sizes;
  std::thread::id taken_by;
  static inline Tunable* last = nullptr;
  static inline Context::State* state = nullptr;
};

WrittenValues values(const std::string& name, const std::string& value) { return {{name, {{value}, false, {}}}}; }

std::optional<ParameterDescription> parameter(const std::string& name) {
  for (auto& one : Tunable::state->parameters()) {
    if (one.name == name) return one;
  }
  return std::nullopt;
}

TEST(ParameterSetting, GivesTheComponentAllOfTheStructWithTheNewValue) {
  ComponentHarness harness;
  harness.add<Tunable>("tunable", {{"gain", "0.25"}});
  EXPECT_THAT(Tunable::state->set_parameters(values("mode", "exact")), testing::IsEmpty());
  EXPECT_EQ(Tunable::last->gains.mode, "exact");
  EXPECT_EQ(Tunable::last->gains.gain, 0.25);
  EXPECT_EQ(parameter("mode")->value, "exact");
  EXPECT_EQ(harness.container().changed_parameters()["tunable"]["mode"], "exact");
}

TEST(ParameterSetting, ChecksValuesAsAtTheStart) {
  ComponentHarness harness;
  harness.add<Tunable>("tunable");
  EXPECT_THAT(Tunable::state->set_parameters(values("gain", "2")), ElementsAre(HasSubstr("must be 0..1")));
  EXPECT_THAT(Tunable::state->set_parameters(values("mode", "slow")), ElementsAre(HasSubstr("fast, exact")));
  EXPECT_THAT(Tunable::state->set_parameters(values("gian", "0.1")), ElementsAre(HasSubstr("gain")));
  EXPECT_EQ(Tunable::last->gains.gain, 0.5);
  EXPECT_EQ(parameter("gain")->value, "0.5");
}

TEST(ParameterSetting, TakesFilesOnlyBelowTheFolderOfTheContainer) {
  {
    ComponentHarness harness;
    harness.add<Tunable>("tunable", {{"file", "/of/the/system/file"}});
    EXPECT_THAT(Tunable::state->set_parameters(values("file", "/tmp/store.db")),
                ElementsAre(HasSubstr("must not do; set it in the system file")));
    EXPECT_THAT(Tunable::state->set_parameters(values("mode", "exact")), testing::IsEmpty());
    EXPECT_EQ(Tunable::last->gains.file, "/of/the/system/file");
  }
  ComponentHarness harness({.replay = true, .files_below = "/tmp"});
  harness.add<Tunable>("tunable");
  EXPECT_THAT(Tunable::state->set_parameters(values("file", "/tmp/../etc/passwd")),
              ElementsAre(HasSubstr("not below")));
  EXPECT_THAT(Tunable::state->set_parameters(values("file", "/tmp/store.db")), testing::IsEmpty());
  EXPECT_EQ(Tunable::last->gains.file, "/tmp/store.db");
}

TEST(ParameterSetting, SaysHowToChangeWhatIsFixed) {
  ComponentHarness harness;
  harness.add<Tunable>("tunable");
  EXPECT_THAT(Tunable::state->set_parameters(values("size", "5")), ElementsAre(HasSubstr("reload the component")));
  EXPECT_FALSE(parameter("size")->settable);
  EXPECT_TRUE(parameter("gain")->settable);
}

TEST(ParameterSetting, LeavesAllAsItWasWhenTheComponentRefuses) {
  ComponentHarness harness;
  harness.add<Tunable>("tunable");
  EXPECT_THAT(Tunable::state->set_parameters(values("gain", "1")), ElementsAre(HasSubstr("this camera")));
  EXPECT_EQ(parameter("gain")->value, "0.5");
}

TEST(ParameterSetting, IsOnTheComponentsOwnThreadLive) {
  ComponentHarness harness(ContainerOptions{.replay = false});
  harness.add<Tunable>("tunable");
  harness.container().start();
  EXPECT_THAT(Tunable::state->set_parameters(values("gain", "0.75")), testing::IsEmpty());
  EXPECT_EQ(Tunable::last->gains.gain, 0.75);
  EXPECT_NE(Tunable::last->taken_by, std::this_thread::get_id());
}

}  // namespace
}  // namespace panvo::runtime
