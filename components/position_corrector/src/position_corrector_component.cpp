// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>
#include <string>

#include "match_messages.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo/runtime/component.hpp"

namespace panvo::position_corrector {

struct ComponentParameters {
  MatchingParameters matching;
  landmarks::DescriptionParameters description;
  landmarks::KeypointParameters keypoints;
  int description_seed = 1;
  bool use_position = true;

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.group(&P::matching, "matching");
    field.group(&P::description, "description");
    field.group(&P::keypoints, "keypoints");
    field(&P::description_seed, "description_seed", "",
          "draws the measurement matrices; the same for all that describe panoramas", 0, 1'000'000'000);
    field(&P::use_position, "use_position", "",
          "look only for landmarks near the odometry's position; false: in the whole library, always");
  }
};

/// panorama/image, odometry/binocular, landmarks -> landmarks/match, one message for each panorama, and why it was no match.
class PositionCorrectorComponent final : public runtime::Component {
 public:
  explicit PositionCorrectorComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        timer_(context.times()),
        describer_(parameters_.description, static_cast<std::uint64_t>(parameters_.description_seed)),
        settings_(landmarks::description_settings(parameters_.description,
                                                  static_cast<std::uint64_t>(parameters_.description_seed))),
        matcher_(parameters_.matching, parameters_.keypoints, describer_, &timer_),
        match_(context.output(topics::kLandmarkMatch)) {
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    context.input(topics::kOdometryBinocular, [this](const auto& message) { on_odometry(*message); });
    context.input(topics::kPanorama, [this](const auto& message) { on_panorama(*message); });
  }

 private:
  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    auto landmark = landmarks::to_landmark(message, settings_);
    if (!landmark) return say_once(fmt::format("a landmark {} and is left out", landmark.reason()));
    // one that comes again is where it is known to be by now
    if (library_.set_pose(landmark->id, landmark->map_from_base, landmark->covariance)) return;
    matcher_.added(library_.add(*landmark));
  }

  void on_odometry(const nav_msgs::msg::Odometry& message) {
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) return say_once(fmt::format("{} {}", topics::kOdometryBinocular.name, pose.reason()));
    if (prior_) travelled_m_ += (pose->translation() - prior_->position).norm();
    const auto covariance = conversions::to_matrix(message.pose().covariance());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread(covariance.topLeftCorner<2, 2>());
    prior_ = PositionPrior{pose->translation(), std::sqrt(std::max(0.0, spread.eigenvalues().maxCoeff()))};
  }

  void on_panorama(const sensor_msgs::msg::Image& message) {
    const auto panorama = conversions::grey(message);
    if (!panorama) return say_once(fmt::format("{} {}", topics::kPanorama.name, panorama.reason()));
    if (!prior_ && parameters_.use_position) {
      say_once(fmt::format("nothing on {} yet: the whole library is searched", topics::kOdometryBinocular.name));
    }
    const auto match = matcher_.match({.stamp_ns = conversions::stamp_ns(message),
                                       .panorama = *panorama,
                                       .travelled_m = travelled_m_,
                                       .prior = parameters_.use_position ? prior_ : std::nullopt},
                                      library_);
    match_.publish(to_message(match, message.header().frame_id()));
    if (match.state == MatchState::kMatched) {
      context_.log().info("landmark {} passed, heading {:+.1f} deg against the first time", match.landmark_id,
                          match.heading_rad * 180.0 / M_PI);
    } else if (match.state == MatchState::kUnusable) {
      say_once(fmt::format("{} {}", topics::kPanorama.name, match.reason));
    }
  }

  /// Says what is wrong when it begins, not with every message.
  void say_once(const std::string& warning) {
    if (warning == last_warning_) return;
    last_warning_ = warning;
    context_.log().warn("{}", warning);
  }

  runtime::Context& context_;
  const ComponentParameters parameters_;
  conversions::StageTimer timer_;
  const landmarks::PanoramaDescriber describer_;
  const landmarks::DescriptionSettings settings_;
  landmarks::LandmarkLibrary library_;
  LandmarkMatcher matcher_;
  runtime::Output<panvo_msgs::msg::LandmarkMatch> match_;

  std::optional<PositionPrior> prior_;
  double travelled_m_ = 0.0;
  std::string last_warning_;
};

PANVO_REGISTER_COMPONENT(PositionCorrectorComponent)

}  // namespace panvo::position_corrector
