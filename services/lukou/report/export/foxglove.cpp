#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/duration.pb.h>
#include <google/protobuf/timestamp.pb.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/core/math.hpp"
#include "common/core/version.hpp"
#include "common/run_log/mcap_writer.hpp"
#include "foxglove.pb.h"
#include "services/lukou/report/export/recorded_cars.hpp"
#include "services/lukou/report/export/trajectory_files.hpp"
#include "services/lukou/report/output_file.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/plots/signals.hpp"

namespace lukou::report {
namespace {

constexpr double kCarHeight_m = 1.5;
constexpr double kHeadThickness_m = 0.8;
constexpr double kCurvePoints = 16;

struct Paint {
  double r, g, b;
};
constexpr Paint kRoadPaint{0.55, 0.6, 0.65};
constexpr Paint kUnequippedPaint{0.84, 0.37, 0.0};
constexpr Paint kEquippedPaint{0.0, 0.45, 0.7};
constexpr Paint kAdvisedPaint{0.0, 0.62, 0.45};

void fill(foxglove::Color& color, const Paint& paint) {
  color.set_r(paint.r);
  color.set_g(paint.g);
  color.set_b(paint.b);
  color.set_a(1.0);
}

Paint paint_of(Aspect aspect) {
  switch (aspect) {
    case Aspect::kRed:
      return {0.85, 0.2, 0.15};
    case Aspect::kYellow:
      return {0.95, 0.75, 0.1};
    case Aspect::kGreen:
      return {0.15, 0.65, 0.35};
  }
  return {};
}

std::uint64_t nanoseconds(Step step) { return static_cast<std::uint64_t>(step) * run_log::kStep_ns; }

foxglove::SceneEntity& add_entity(foxglove::SceneUpdate& update, const char* id, Step step) {
  constexpr std::uint64_t kSecond_ns = 1'000'000'000;
  foxglove::SceneEntity& entity = *update.add_entities();
  entity.mutable_timestamp()->set_seconds(static_cast<std::int64_t>(nanoseconds(step) / kSecond_ns));
  entity.mutable_timestamp()->set_nanos(static_cast<std::int32_t>(nanoseconds(step) % kSecond_ns));
  entity.set_frame_id("map");
  entity.set_id(id);
  return entity;
}

void add_point(foxglove::LinePrimitive& line, double x_m, double y_m) {
  foxglove::Point3& point = *line.add_points();
  point.set_x(x_m);
  point.set_y(y_m);
}

/// The middle of each lane's path.
void add_roads(foxglove::SceneUpdate& update, const RoadLengths& road) {
  foxglove::SceneEntity& entity = add_entity(update, "roads", 0);
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    foxglove::LinePrimitive& line = *entity.add_lines();
    line.set_thickness(2.0);
    line.set_scale_invariant(true);
    fill(*line.mutable_color(), kRoadPaint);
    std::vector<double> places = {0.0};
    for (int point = 0; point <= static_cast<int>(kCurvePoints); ++point) {
      places.push_back(road.approach_m + curve_length_m(lane) * point / kCurvePoints);
    }
    places.push_back(road.approach_m + road.exit_m);
    for (const double place_m : places) {
      const Pose pose = pose_on_path(road, lane, place_m);
      add_point(line, pose.x_m, pose.y_m);
    }
  }
}

/// A bar over each lane at its stop line.
void add_heads(foxglove::SceneUpdate& update, const std::array<Aspect, kLanes>& heads, const RoadLengths& road,
               Step step) {
  foxglove::SceneEntity& entity = add_entity(update, "heads", step);
  for (int i = 0; i < kLanes; ++i) {
    const Pose line_at = pose_on_path(road, static_cast<Lane>(i), road.approach_m);
    foxglove::LinePrimitive& bar = *entity.add_lines();
    bar.set_thickness(kHeadThickness_m);
    fill(*bar.mutable_color(), paint_of(heads[static_cast<std::size_t>(i)]));
    const double across_x = math::cos(line_at.heading_rad) * kLaneWidth_m / 2;
    const double across_y = -math::sin(line_at.heading_rad) * kLaneWidth_m / 2;
    add_point(bar, line_at.x_m - across_x, line_at.y_m - across_y);
    add_point(bar, line_at.x_m + across_x, line_at.y_m + across_y);
  }
}

void add_car(foxglove::SceneEntity& entity, const RecordedCar& car, const RoadFacts& facts) {
  const Pose middle = pose_on_path(facts.road, car.lane, car.position_m - facts.vehicle_length_m / 2);
  const double yaw_rad = math::kPi / 2 - middle.heading_rad;  // counter-clockwise from the east
  foxglove::CubePrimitive& cube = *entity.add_cubes();
  foxglove::Vector3& place = *cube.mutable_pose()->mutable_position();
  place.set_x(middle.x_m);
  place.set_y(middle.y_m);
  place.set_z(kCarHeight_m / 2);
  cube.mutable_pose()->mutable_orientation()->set_z(math::sin(yaw_rad / 2));
  cube.mutable_pose()->mutable_orientation()->set_w(math::cos(yaw_rad / 2));
  cube.mutable_size()->set_x(facts.vehicle_length_m);
  cube.mutable_size()->set_y(facts.vehicle_width_m);
  cube.mutable_size()->set_z(kCarHeight_m);
  fill(*cube.mutable_color(), car.advised ? kAdvisedPaint : car.equipped ? kEquippedPaint : kUnequippedPaint);
}

/// What every head shows, asked for rising steps.
class Heads {
 public:
  static Expected<Heads> of(const Result& result) {
    Heads heads;
    for (int i = 0; i < kLanes; ++i) {
      auto spans = aspect_spans(result, static_cast<Lane>(i), {0.0, end_s(result) + kStep_s});
      if (!spans) return spans.error();
      heads.spans_[static_cast<std::size_t>(i)] = std::move(spans).value();
    }
    return heads;
  }
  /// Red where nobody says.
  std::array<Aspect, kLanes> at(Step step) {
    std::array<Aspect, kLanes> heads{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const auto& spans = spans_[lane];
      while (next_[lane] < spans.size() && spans[next_[lane]].to_s < time_s(step) + kStep_s / 2) ++next_[lane];
      heads[lane] = next_[lane] < spans.size() ? spans[next_[lane]].aspect : Aspect::kRed;
    }
    return heads;
  }

 private:
  std::array<std::vector<AspectSpan>, kLanes> spans_;
  std::array<std::size_t, kLanes> next_{};
};

std::string descriptors() {
  google::protobuf::FileDescriptorSet set;
  google::protobuf::Timestamp::descriptor()->file()->CopyTo(set.add_file());
  google::protobuf::Duration::descriptor()->file()->CopyTo(set.add_file());
  foxglove::SceneUpdate::descriptor()->file()->CopyTo(set.add_file());
  return set.SerializeAsString();
}

}  // namespace

Expected<Done> write_foxglove(const Result& result, Step period, const std::filesystem::path& file) {
  auto heads = Heads::of(result);
  if (!heads) return heads.error();
  auto output = OutputFile::create(file);
  if (!output) return output.error();
  // The writer makes its file by itself; it stands beside until it is whole.
  std::filesystem::remove(output.value().unfinished());
  auto writer = run_log::McapWriter::create(output.value().unfinished(), "lukou " + std::string(version()));
  if (!writer) return writer.error();
  const std::uint16_t channel = writer.value().add_channel("/scene", "foxglove.SceneUpdate", descriptors());
  const RoadFacts facts = road_facts(result);
  std::optional<std::array<Aspect, kLanes>> shown;
  auto told = for_each_instant(result, period, [&](Step step, const TrafficBatch& batch) -> Expected<Done> {
    foxglove::SceneUpdate update;
    if (!shown) add_roads(update, facts.road);
    const auto now = heads.value().at(step);
    if (shown != now) add_heads(update, now, facts.road, step);
    shown = now;
    foxglove::SceneEntity& cars = add_entity(update, "cars", step);
    for (std::size_t i = 0; i < batch.vehicle.size(); ++i) add_car(cars, recorded_car(batch, i, facts.road), facts);
    writer.value().add(channel, nanoseconds(step), static_cast<std::uint32_t>(step), update.SerializeAsString());
    const bool full = step / period % run_log::kChunkSteps == run_log::kChunkSteps - 1;
    return full ? writer.value().end_chunk() : Expected<Done>(Done{});
  });
  if (!told) return told;
  if (auto closed = writer.value().close(); !closed) return closed;
  return output.value().finish();
}

}  // namespace lukou::report
