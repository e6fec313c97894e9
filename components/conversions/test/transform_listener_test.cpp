// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/transform_listener.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::conversions {
namespace {

tf2_msgs::msg::TFMessage message(const std::string& parent, const std::string& child, double x) {
  tf2_msgs::msg::TFMessage tf;
  tf.transforms().push_back(to_static_transform(0, parent, child, Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0))));
  return tf;
}

struct Listening : runtime::Component {
  Listening(runtime::Context& context, TransformListener::Frames frames) : transforms(context, frames) {}
  TransformListener transforms;
};

class TransformListenerTest : public testing::TestWithParam<TransformListener::Frames> {
 protected:
  TransformListenerTest() {
    runtime::ComponentDescription description;
    description.name = "listening";
    harness_.container().add(description, [this](runtime::Context& context) {
      auto component = std::make_unique<Listening>(context, GetParam());
      transforms_ = &component->transforms;
      return component;
    });
  }

  runtime::ComponentHarness harness_;
  const TransformListener* transforms_ = nullptr;
};

TEST_P(TransformListenerTest, FollowsItsTopics) {
  harness_.publish(topics::kTfStatic, message("base_link", "left", 1.0));
  harness_.publish(topics::kTf, message("odom", "base_link", 2.0));
  EXPECT_TRUE(transforms_->buffer().lookup("base_link", "left"));
  EXPECT_EQ(transforms_->buffer().lookup("odom", "left", 0).has_value(),
            GetParam() == TransformListener::Frames::kMoving);
}

INSTANTIATE_TEST_SUITE_P(Of, TransformListenerTest,
                         testing::Values(TransformListener::Frames::kStatic, TransformListener::Frames::kMoving),
                         [](const auto& frames) {
                           return frames.param == TransformListener::Frames::kStatic ? "Static" : "Moving";
                         });

TEST_P(TransformListenerTest, WarnsOfAMissingChainWithTheRemedy) {
  EXPECT_FALSE(transforms_->lookup("base_link", "left", "publish it"));
  EXPECT_TRUE(harness_.log_contains("/tf_static has no chain from base_link to left yet: publish it"));
  harness_.publish(topics::kTfStatic, message("base_link", "left", 1.0));
  EXPECT_DOUBLE_EQ(transforms_->lookup("base_link", "left", "publish it")->translation().x(), 1.0);
}

TEST_P(TransformListenerTest, WarnsOfAnInvalidTransform) {
  harness_.publish(topics::kTfStatic, message("left", "left", 1.0));
  EXPECT_TRUE(harness_.log_contains("does not name two different frames"));
}

}  // namespace
}  // namespace panvo::conversions
