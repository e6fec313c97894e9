// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "component_parameters.hpp"
#include "fleet_messages.hpp"
#include "fleet_pose_publisher.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/fleet/fleet.hpp"
#include "panvo/interfaces/fleet_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/id_disputes.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/last_kept.hpp"
#include "panvo/landmarks/map_listener.hpp"
#include "panvo/landmarks/panorama_level.hpp"
#include "panvo/position_corrector/spilled_landmarks.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::fleet {

/// landmarks, landmarks/poses, odometry/enhanced, panorama/image, /fleet/... -> /fleet/..., fleet/state, odometry/fleet,
/// /tf.
class FleetComponent final : public runtime::Component {
 public:
  explicit FleetComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        timer_(context.times()),
        describer_(parameters_.description, static_cast<std::uint64_t>(parameters_.description_seed)),
        settings_(landmarks::landmark_settings(parameters_.description, parameters_.keypoints,
                                               static_cast<std::uint64_t>(parameters_.description_seed))),
        members_(context.output(topics::kFleetMembers)),
        places_(context.output(topics::kFleetPlaces)),
        requests_(context.output(topics::kFleetRequests)),
        keypoints_(context.output(topics::kFleetKeypoints)),
        state_(context.output(topics::kFleetState)),
        pose_(context, parameters_.fleet_frame),
        transforms_(context),
        map_(context, [this](const auto& moved) { on_moved(moved); }) {
    begin();
    if (parameters_.robot.empty()) {
      throw runtime::ConfigError(context.name() + ": robot is empty: give each robot a name of its own, robot:=NAME");
    }
    context.set_background();
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    context.input(topics::kOdometryEnhanced, [this](const auto& message) { on_odometry(*message); });
    context.input(topics::kLocalizationState, [this](const auto& message) { on_state(message->state()); });
    context.input(topics::kPanorama, [this](const auto& message) { on_panorama(message); });
    context.input(topics::kFleetMembers, [this](const auto& message) { on_member(*message); });
    context.input(topics::kFleetPlaces, [this](const auto& message) { on_places(*message); });
    context.input(topics::kFleetRequests, [this](const auto& message) { on_request(*message); });
    context.input(topics::kFleetKeypoints, [this](const auto& message) { on_keypoints(*message); });
    context.every(std::chrono::milliseconds(kTick_ms), [this] { on_tick(); });
    context.on_diagnostics([this] { return diagnostics(); });
    context.on_end([this] { report(); });
    context.log().info("this robot is {}", fleet_->robot());
  }

 private:
  /// Landmarks that may belong to a new map. The localizer publishes poses with each landmark, which soon show it.
  static constexpr std::size_t kMaxRefused = 100;
  static constexpr int kTick_ms = 200;
  static constexpr int kStateTicks = 5;

  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    const auto read = landmarks::to_landmark(message, settings_);
    if (!read) {
      return context_.log().warn_throttled(fmt::format("landmark {}", message.id()), "a landmark {}; not shared",
                                           read.reason());
    }
    const bool is_other = map_.map().is_other(*read);
    if (is_other || !since_refused_.empty()) keep_refused(*read);
    if (!is_other) return add(*read);
    context_.log().warn_throttled(fmt::format("landmark {}", read->id),
                                  "landmark {}: its id is that of another one; not shared", read->id);
    if (disputes_.begin({read->id, read->map_from_base, read->covariance})) start_new_map({});
  }

  /// The last one of each id, and not too many.
  void keep_refused(const landmarks::PanoramicLandmark& landmark) {
    since_refused_.forget_if([&](const auto& kept) { return kept.id == landmark.id; });
    since_refused_.add(landmark);
  }

  void add(landmarks::PanoramicLandmark landmark) {
    map_.map().add(landmark);
    disputes_.keep({landmark.id, landmark.map_from_base, landmark.covariance});
    base_from_panorama_ = landmark.base_from_panorama;
    own_keypoints_->put(landmark.id, landmark.keypoints);
    fleet_->add_place(std::move(landmark));
  }

  void on_moved(const std::vector<landmarks::LandmarkPose>& moved) {
    bool is_of_another_map = false, is_of_this_map = false;
    for (const auto& pose : moved) {
      const bool is_own = disputes_.move(pose);
      is_of_another_map |= !is_own;
      is_of_this_map |= is_own && disputes_.is_disputed(pose.id);
    }
    if (is_of_another_map) return start_new_map(moved);
    if (is_of_this_map) since_refused_.take();
    fleet_->move_places(moved);
  }

  void begin() {
    own_keypoints_ = std::make_shared<position_corrector::SpilledLandmarks>(parameters_.spill_folder);
    fleet_.emplace(FleetParameters{parameters_.sharing, parameters_.members, parameters_.recognition, parameters_.join},
                   parameters_.robot, parameters_.keypoints, describer_, settings_, own_keypoints_, &timer_);
  }

  /// The robot's other components were restarted and have started a map: the landmarks that were refused are its own, and the
  /// localizer's poses are theirs. For the fleet, this robot was restarted, too.
  void start_new_map(const std::vector<landmarks::LandmarkPose>& poses) {
    context_.log().warn("this robot has started a new map: it is shared as another one");
    begin();
    disputes_ = {};
    map_.map() = {};
    map_.map().move(poses);
    if (since_refused_.dropped() > 0) {
      context_.log().warn("{} of its landmarks are not shared: more than {} came before it was known to be new",
                          since_refused_.dropped(), since_refused_.most());
    }
    for (auto& landmark : since_refused_.take()) add(std::move(landmark));
  }

  /// A pose that is not known in the own map says nothing of other maps.
  void on_state(std::uint8_t state) {
    using namespace panvo_msgs::msg::LocalizationState_Constants;
    is_located_ = state != UNLOCATED && state != LOST;
  }

  void on_odometry(const nav_msgs::msg::Odometry& message) {
    if (!is_located_) return;
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) return;
    const auto& linear = message.twist().twist().linear();
    const double speed = std::hypot(linear.x(), linear.y(), linear.z());
    const auto covariance = conversions::to_matrix(message.pose().covariance());
    fleet_->add_pose(conversions::stamp_ns(message), *pose, covariance, std::isfinite(speed) ? speed : 0.0);
    use_waiting();
    pose_.publish(message, *pose, covariance, *fleet_);
  }

  /// A panorama waits for the pose of its stamp; only the latest one does.
  void on_panorama(std::shared_ptr<const sensor_msgs::msg::Image> message) {
    waiting_ = std::move(message);
    use_waiting();
  }

  void use_waiting() {
    if (!waiting_ || !fleet_->has_pose_at(conversions::stamp_ns(*waiting_))) return;
    const auto message = std::exchange(waiting_, nullptr);
    const auto panorama = conversions::grey(*message);
    if (!panorama) {
      return context_.log().warn_throttled("panorama", "{} {}", context_.resolved_name(topics::kPanorama),
                                           panorama.reason());
    }
    const auto base_from_panorama =
        transforms_
            .lookup(parameters_.base_frame, message->header().frame_id(), "using the extrinsics of the last landmark")
            .value_or(base_from_panorama_);
    if (base_from_panorama.matrix() != level_.base_from_panorama().matrix()) {
      level_ = landmarks::PanoramaLevel(base_from_panorama);
    }
    if (const auto fault =
            fleet_->add_panorama(conversions::stamp_ns(*message), level_.level(*panorama), level_.base_from_level())) {
      context_.log().warn_throttled(*fault, "{} {}", context_.resolved_name(topics::kPanorama), *fault);
    }
    send();
  }

  /// Whether another robot sent the message: what a component publishes it also receives.
  template <class Message>
  bool is_of_other(const Message& message) {
    if (message.robot() == fleet_->robot()) return false;
    received_.add(context_.passing_ns(), interfaces::message_type<Message>().serialized_size(&message));
    return true;
  }

  template <class Topic>
  void note(const Topic& topic, const std::string& robot, const std::optional<std::string>& refused) {
    if (!refused) return;
    ++refused_;
    last_refusal_ = *refused;
    if (context_.rejections().add(topic.name, *refused, robot)) context_.log().warn("{}: {}", topic.name, *refused);
  }

  void on_member(const panvo_msgs::msg::FleetMember& message) {
    is_of_other(message);  // one of the own name may be another robot's
    note(topics::kFleetMembers, message.robot(), fleet_->hear(to_announcement(message), context_.passing_ns()));
  }

  void on_places(const panvo_msgs::msg::FleetPlaces& message) {
    if (!is_of_other(message)) return;
    const auto changes = to_changes(message, settings_);
    note(topics::kFleetPlaces, message.robot(),
         changes ? fleet_->take(message.robot(), *changes, context_.passing_ns()) : std::optional(changes.reason()));
  }

  void on_request(const panvo_msgs::msg::FleetRequest& message) {
    if (!is_of_other(message)) return;
    note(topics::kFleetRequests, message.robot(),
         fleet_->answer(message.robot(), to_request(message), context_.passing_ns()));
    send();
  }

  void on_keypoints(const panvo_msgs::msg::FleetKeypoints& message) {
    if (!is_of_other(message)) return;
    note(topics::kFleetKeypoints, message.robot(), fleet_->take(message.robot(), to_answer(message)));
    send();
  }

  void on_tick() {
    {
      const vision::Stage stage(&timer_, "join");
      fleet_->advance(context_.passing_ns());
    }
    send();
    for (const auto& news : fleet_->take_news()) {
      context_.log().info("{}", news);
      ticks_since_state_ = kStateTicks;
    }
    if (++ticks_since_state_ >= kStateTicks) publish_state();
  }

  void send() {
    const Sender sender{fleet_->robot(), parameters_.map_frame, context_.now_ns()};
    while (const auto message = fleet_->next(context_.passing_ns())) {
      std::visit([&](const auto& content) { publish(to_message(content, sender)); }, *message);
    }
  }

  void publish(panvo_msgs::msg::FleetMember message) { publish(members_, std::move(message)); }
  void publish(panvo_msgs::msg::FleetPlaces message) { publish(places_, std::move(message)); }
  void publish(panvo_msgs::msg::FleetRequest message) { publish(requests_, std::move(message)); }
  void publish(panvo_msgs::msg::FleetKeypoints message) { publish(keypoints_, std::move(message)); }

  template <class Message>
  void publish(runtime::Output<Message>& output, Message message) {
    const auto bytes = interfaces::message_type<Message>().serialized_size(&message);
    fleet_->sent(bytes);
    sent_.add(context_.passing_ns(), bytes);
    output.publish(std::move(message));
  }

  void publish_state() {
    ticks_since_state_ = 0;
    auto state = to_state(*fleet_, parameters_.fleet_frame, context_.now_ns());
    state.bytes_sent(sent_.total());
    state.bytes_received(received_.total());
    state.bytes_per_s(sent_.per_s(context_.passing_ns()));
    state.refused(refused_);
    state.last_refusal(last_refusal_);
    bytes_sent_ = state.bytes_sent();
    bytes_received_ = state.bytes_received();
    bytes_per_s_ = state.bytes_per_s();
    robots_ = fleet_->members().present().size();
    joined_ = fleet_->frame().own_from.size();
    state_.publish(std::move(state));
  }

  void report() const {
    const auto& counts = fleet_->counts();
    context_.log().info(
        "{:.1f} kB sent, {:.1f} kB received; {} panoramas compared with {} places, {} candidates, {} verified, {} "
        "recognised; {} joins made, {} undone",
        1e-3 * static_cast<double>(sent_.total()), 1e-3 * static_cast<double>(received_.total()), counts.panoramas,
        counts.compared, counts.candidates, counts.verified, counts.recognised, fleet_->evidence().made(),
        fleet_->evidence().undone());
  }

  /// Called on another thread.
  runtime::DiagnosticValues diagnostics() const {
    return {{"robot", parameters_.robot},
            {"other robots", std::to_string(robots_)},
            {"joined maps", std::to_string(joined_)},
            {"bytes sent", std::to_string(bytes_sent_)},
            {"bytes sent per second", fmt::format("{:.0f}", bytes_per_s_.load())},
            {"bytes received", std::to_string(bytes_received_)}};
  }

  runtime::Context& context_;
  const ComponentParameters parameters_;
  conversions::StageTimer timer_;
  const landmarks::PanoramaDescriber describer_;
  const landmarks::DescriptionSettings settings_;
  std::shared_ptr<position_corrector::SpilledLandmarks> own_keypoints_;
  std::optional<Fleet> fleet_;  // always there
  runtime::Output<panvo_msgs::msg::FleetMember> members_;
  runtime::Output<panvo_msgs::msg::FleetPlaces> places_;
  runtime::Output<panvo_msgs::msg::FleetRequest> requests_;
  runtime::Output<panvo_msgs::msg::FleetKeypoints> keypoints_;
  runtime::Output<panvo_msgs::msg::FleetState> state_;
  FleetPosePublisher pose_;
  conversions::TransformListener transforms_;
  landmarks::MapListener map_;
  landmarks::IdDisputes disputes_;
  // The first one of the id of another one, and all after it.
  landmarks::LastKept<landmarks::PanoramicLandmark> since_refused_{kMaxRefused};

  Eigen::Isometry3d base_from_panorama_ = Eigen::Isometry3d::Identity();
  landmarks::PanoramaLevel level_;
  std::shared_ptr<const sensor_msgs::msg::Image> waiting_;
  bool is_located_ = true;
  ByteCount sent_, received_;
  std::uint32_t refused_ = 0;
  std::string last_refusal_;
  int ticks_since_state_ = 0;
  // for the diagnostics
  std::atomic<std::uint64_t> bytes_sent_ = 0, bytes_received_ = 0;
  std::atomic<std::size_t> robots_ = 0, joined_ = 0;
  std::atomic<double> bytes_per_s_ = 0.0;
};

PANVO_REGISTER_COMPONENT(FleetComponent)

}  // namespace panvo::fleet
