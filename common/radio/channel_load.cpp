#include "common/radio/channel_load.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"
#include "common/core/math.hpp"
#include "common/intersection/geometry.hpp"
#include "common/radio/path_loss.hpp"

namespace lukou {
namespace {

constexpr double kBinMin_m = 25.0;
constexpr double kBinsPerReachMax = 60.0;
constexpr double kSubframes = 100.0;       // in 100 ms
constexpr double kFramesPerSecond = 10.0;  // of a reservation
constexpr double kCandidateShare = 0.2;    // of all resources: at least so many to choose from (3GPP TS 36.213)
constexpr double kAdvantageStep_db = 0.1;
constexpr double kAdvantageMax_db = 60.0;

/// Mean power of a link [dBm], and the probability that it is heard. Between cars of one street the states of sight
/// count with their probabilities.
struct LinkBudget {
  double power_dbm = 0.0;
  double sensed = 0.0;
};

LinkBudget budget(const PathLossModel& model, const PlanePoint& a, const PlanePoint& b, bool mast) {
  const double sent_dbm = model.power_dbm + model.antenna_gain_dbi;
  const auto in = [&](Sight sight, double extra_db, double extra_deviation_db) {
    const double power_dbm = sent_dbm - path_loss_db(model, sight, a, b) - extra_db;
    const double shadow_db = shadowing_law(model, sight).deviation_db;
    const double deviation_db = std::sqrt(shadow_db * shadow_db + extra_deviation_db * extra_deviation_db);
    return LinkBudget{power_dbm, math::normal_cdf((power_dbm - model.sensitivity_dbm) / deviation_db)};
  };
  if (mast) return in(Sight::kClear, 0.0, 0.0);
  if (around_corner(a, b)) return in(Sight::kCorner, 0.0, 0.0);
  const double away_m = distance_m(a, b);
  const double seen = clear_probability(model, away_m);
  const LinkBudget clear = in(Sight::kClear, 0.0, 0.0);
  if (seen >= 1.0) return clear;
  const LinkBudget blocked = in(Sight::kBlocked, blocker_mean_db(away_m), kBlockerDeviation_db);
  return {seen * clear.power_dbm + (1.0 - seen) * blocked.power_dbm,
          seen * clear.sensed + (1.0 - seen) * blocked.sensed};
}

/// Resources of `all` that are in use in the eyes of a station that hears `heard` uses of them: half of them are known
/// from the last announcement, the other half from those that announced before and may coincide with the first.
double resources_in_use(double all, double heard) {
  const double half = 0.5 * heard;
  const double left = all - half;
  if (left <= 0.0) return all;
  const double others = half <= left ? half - half * (half + 1.0) / (2.0 * left) : 0.5 * (left - 1.0);
  return std::clamp(half + others, 0.0, all);
}

}  // namespace

double load_reach_m(double approach_m, double exit_m) { return std::max(approach_m, exit_m) + kStopLineOffset_m; }

ChannelLoad::ChannelLoad(const LoadModel& model, double reach_m) : model_(model) {
  bin_m_ = std::max(kBinMin_m, reach_m / kBinsPerReachMax);
  per_street_ = 2 * static_cast<std::size_t>(std::ceil(reach_m / bin_m_));
  bins_ = 2 * per_street_ + 1;
  if (model_.counted) build();
}

void ChannelLoad::use(const LoadModel& model, Step from) {
  if (model == model_) return;
  model_ = model;
  from_ = from;
  roadside_frames_ = roadside_sub_channels_ = busy_of_cars_ = 0.0;
  frames_.clear(), busy_.clear(), used_.clear();
  if (model_.counted) build();
}

void ChannelLoad::build() {
  LUKOU_EXPECT(model_.path_loss.law != PathLossModel::Law::kNone);
  power_dbm_.assign(bins_ * bins_, 0.0);
  sensed_.assign(bins_ * bins_, 0.0);
  common_.assign(bins_ * bins_, 0.0);
  survival_.assign(bins_ * bins_, {});
  for (std::size_t a = 0; a < bins_; ++a) {
    for (std::size_t b = a; b < bins_; ++b) {
      PlanePoint to = centre_of(b);
      // Two stations of one bin are on average a third of its length apart.
      if (a == b) to.x_m += bin_m_ / 3.0;
      const LinkBudget link = budget(model_.path_loss, centre_of(a), to, b == mast());
      power_dbm_[pair(a, b)] = power_dbm_[pair(b, a)] = link.power_dbm;
      sensed_[pair(a, b)] = sensed_[pair(b, a)] = link.sensed;
    }
  }
  // What two stations hear in common, if the streets were evenly full.
  const auto heard_by_both = [&](std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (std::size_t c = 0; c < mast(); ++c) sum += sensed_[pair(a, c)] * sensed_[pair(b, c)];
    return sum;
  };
  std::vector<double> alone(bins_);
  for (std::size_t a = 0; a < bins_; ++a) alone[a] = heard_by_both(a, a);
  for (std::size_t a = 0; a < bins_; ++a) {
    for (std::size_t b = a; b < bins_; ++b) {
      const double scale = std::sqrt(alone[a] * alone[b]);
      common_[pair(a, b)] = common_[pair(b, a)] = scale > 0.0 ? std::min(1.0, heard_by_both(a, b) / scale) : 0.0;
    }
  }
  // Both powers are shadowed, so the ratio has the root of two deviations.
  const double deviation_db = shadowing_law(model_.path_loss, Sight::kClear).deviation_db * std::sqrt(2.0);
  too_strong_.clear();
  for (int i = 0; i <= static_cast<int>(2.0 * kAdvantageMax_db / kAdvantageStep_db); ++i) {
    const double advantage_db = -kAdvantageMax_db + kAdvantageStep_db * static_cast<double>(i);
    too_strong_.push_back(math::normal_cdf((model_.sir_threshold_db - advantage_db) / deviation_db));
  }
}

std::size_t ChannelLoad::bin_of(const PlanePoint& at) const {
  const Arm arm = arm_of(at);
  const bool east_west = arm == Arm::kWest || arm == Arm::kEast;
  const double half = 0.5 * static_cast<double>(per_street_);
  const double place = std::floor((east_west ? at.x_m : at.y_m) / bin_m_) + half;
  const auto bin = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(per_street_ - 1)));
  return east_west ? bin : per_street_ + bin;
}

PlanePoint ChannelLoad::centre_of(std::size_t bin) const {
  if (bin == mast()) return {};
  const bool east_west = bin < per_street_;
  const auto place = static_cast<double>(east_west ? bin : bin - per_street_);
  const double along_m = (place + 0.5 - 0.5 * static_cast<double>(per_street_)) * bin_m_;
  return east_west ? PlanePoint{along_m, 0.0} : PlanePoint{0.0, along_m};
}

std::uint32_t ChannelLoad::width(std::uint32_t wire_bytes) const {
  const std::uint32_t bytes = wire_bytes + model_.security_bytes;
  return std::max(1U, (bytes + model_.bytes_per_sub_channel - 1) / model_.bytes_per_sub_channel);
}

void ChannelLoad::add_roadside(const Frames& frames, Step at) {
  if (!model_.counted || at < from_) return;
  for (const std::uint32_t bytes : frames.wire_bytes) {
    roadside_frames_ += 1.0;
    roadside_sub_channels_ += width(bytes);
  }
}

void ChannelLoad::add_air(const Frames& frames, Step at) {
  if (!model_.counted || at < from_ || at % kStepsPerSecond != 0) return;
  frames_.assign(bins_, 0.0);
  sub_channels_.assign(bins_, 0.0);
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const std::size_t bin = bin_of({frames.antenna_x_m[frame], frames.antenna_y_m[frame]});
    frames_[bin] += 1.0;
    sub_channels_[bin] += width(frames.wire_bytes[frame]);
  }
  frames_[mast()] = roadside_frames_ / static_cast<double>(kStepsPerSecond);
  sub_channels_[mast()] = roadside_sub_channels_ / static_cast<double>(kStepsPerSecond);
  roadside_frames_ = roadside_sub_channels_ = 0.0;
  update();
}

void ChannelLoad::update() {
  ++update_;
  used_.clear();
  for (std::size_t bin = 0; bin < bins_; ++bin)
    if (frames_[bin] > 0.0) used_.push_back(bin);
  const double all = kSubframes * model_.sub_channels;
  busy_.assign(bins_, 0.0);
  free_.assign(bins_, all);
  double cars = 0.0;
  double sum = 0.0;
  const auto fill = [&](std::size_t bin) {
    double heard = 0.0;
    for (const std::size_t other : used_) heard += sub_channels_[other] * sensed_[pair(bin, other)];
    const double in_use = resources_in_use(all, heard);
    busy_[bin] = in_use / all;
    free_[bin] = std::max(all - in_use, kCandidateShare * all);
  };
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    fill(bin);
    if (bin == mast()) continue;
    cars += frames_[bin];
    sum += frames_[bin] * busy_[bin];
  }
  busy_of_cars_ = cars > 0.0 ? sum / cars : 0.0;
}

double ChannelLoad::busy_ratio(const PlanePoint& car) const { return busy_.empty() ? 0.0 : busy_[bin_of(car)]; }

double ChannelLoad::too_strong(double advantage_db) const {
  const double clamped_db = std::clamp(advantage_db, -kAdvantageMax_db, kAdvantageMax_db);
  return too_strong_[static_cast<std::size_t>((clamped_db + kAdvantageMax_db) / kAdvantageStep_db)];
}

double ChannelLoad::collision(std::size_t sender, std::size_t receiver, std::uint32_t width) {
  if (frames_.empty()) return 0.0;
  Survival& known = survival_[pair(sender, receiver)];
  if (known.update != update_) {
    double colliders_of_one = 0.0;
    double colliders_of_a_further = 0.0;
    const double all = kSubframes * model_.sub_channels;
    const double wanted_dbm = power_dbm_[pair(sender, receiver)];
    for (const std::size_t other : used_) {
      if (other == mast() && (sender == mast() || receiver == mast())) continue;
      // The two do not know of each other: because they do not hear each other, or because both chose since the last
      // frame that they could have heard.
      const double unseen = 1.0 - (1.0 - 1.0 / kFramesPerSecond) * sensed_[pair(sender, other)];
      const double common = common_[pair(sender, other)];
      const double same = unseen * (common / free_[sender] + (1.0 - common) / all);
      const double lost = same * too_strong(wanted_dbm - power_dbm_[pair(receiver, other)]);
      // Neither of the two disturbs itself; of an RSU no frame is left then, see above.
      const double own = (other == sender ? 1.0 : 0.0) + (other == receiver ? 1.0 : 0.0);
      const double others = std::max(0.0, frames_[other] - own);
      colliders_of_one += lost * (frames_[other] > 0.0 ? sub_channels_[other] * others / frames_[other] : 0.0);
      colliders_of_a_further += lost * others;
    }
    known = {
        .update = update_, .of_one = math::exp(-colliders_of_one), .of_a_further = math::exp(-colliders_of_a_further)};
  }
  double survival = known.of_one;
  for (std::uint32_t further = 1; further < width; ++further) survival *= known.of_a_further;
  return 1.0 - survival;
}

double ChannelLoad::collision_to_mast(const PlanePoint& car, std::uint32_t width) {
  return counted() ? collision(bin_of(car), mast(), width) : 0.0;
}

double ChannelLoad::collision_from_mast(const PlanePoint& car, std::uint32_t width) {
  return counted() ? collision(mast(), bin_of(car), width) : 0.0;
}

double ChannelLoad::collision_between(const PlanePoint& sender, const PlanePoint& receiver, std::uint32_t width) {
  return counted() ? collision(bin_of(sender), bin_of(receiver), width) : 0.0;
}

}  // namespace lukou
