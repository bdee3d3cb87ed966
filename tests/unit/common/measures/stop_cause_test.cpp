#include "common/measures/stop_cause.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace lukou {
namespace {

constexpr std::uint8_t number(AdviceFate fate) { return static_cast<std::uint8_t>(fate); }

TEST(StopCause, HasANameOfItsOwn) {
  const std::set<std::string_view> names(kStopCauseNames.begin(), kStopCauseNames.end());
  EXPECT_EQ(names.size(), kStopCauses);
  EXPECT_EQ(name(StopCause::kUnequipped), "unequipped");
  EXPECT_EQ(name(StopCause::kLostOutage), "lost_outage");
  EXPECT_EQ(name(StopCause::kRedWithoutAdvice), "red_without_advice");
}

TEST(StopCause, IsKnownForEveryCombinationOfFacts) {
  std::set<StopCause> seen;
  for (std::size_t guidance = 0; guidance < kGuidanceStates; ++guidance) {
    for (int bound_by = 0; bound_by <= static_cast<int>(BoundBy::kBlock); ++bound_by) {
      for (const bool ahead_stands : {false, true}) {
        for (const AdviceFate missed :
             {AdviceFate::kLostRandom, AdviceFate::kLostBurst, AdviceFate::kLostRange, AdviceFate::kLostPathLoss,
              AdviceFate::kLostCollision, AdviceFate::kLostHalfDuplex, AdviceFate::kLostOutage, AdviceFate::kLate,
              static_cast<AdviceFate>(kNothingMissed)}) {
          for (const bool rsus_silent : {false, true}) {
            seen.insert(stop_cause({.guidance = static_cast<GuidanceState>(guidance),
                                    .bound_by = static_cast<BoundBy>(bound_by),
                                    .ahead_stands = ahead_stands,
                                    .missed = number(missed),
                                    .rsus_silent = rsus_silent}));
          }
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), kStopCauses);  // none is out of reach
}

TEST(StopCause, FollowsTheOrderOfTheDocumentation) {
  const std::uint8_t lost = number(AdviceFate::kLostBurst);
  using enum GuidanceState;
  const std::pair<StopFacts, StopCause> cases[] = {
      // Without a unit nothing else matters.
      {{kNotEquipped, BoundBy::kCarAhead, true}, StopCause::kUnequipped},
      // A standing car ahead comes before what the radio did.
      {{kExpired, BoundBy::kCarAhead, true, lost}, StopCause::kQueueAhead},
      {{kExpired, BoundBy::kCarAhead, false, lost}, StopCause::kQueueAhead},
      {{kExpired, BoundBy::kLight, true, lost}, StopCause::kQueueAhead},
      {{kInForce, BoundBy::kGuard, true}, StopCause::kQueueAhead},
      {{kInForce, BoundBy::kCarAhead, true}, StopCause::kQueueAhead},
      {{kInForce, BoundBy::kBlock}, StopCause::kQueueAhead},
      // The advice itself brought the car down, though a car stands somewhere ahead.
      {{kInForce, BoundBy::kAdvice, true}, StopCause::kAdvised},
      // A rule changed the advice.
      {{kInForce, BoundBy::kLight}, StopCause::kOverriddenRed},
      {{kInForce, BoundBy::kCarAhead}, StopCause::kOverriddenFollowing},
      {{kInForce, BoundBy::kGuard}, StopCause::kOverriddenGuard},
      {{kInForce, BoundBy::kLimit}, StopCause::kOverriddenLimit},
      // The driver comes before the radio.
      {{kNotComplied, BoundBy::kLight, false, lost}, StopCause::kNotComplied},
      {{kReacting, BoundBy::kLight}, StopCause::kNotComplied},
      // A missed word comes before the state that it left behind.
      {{kExpired, BoundBy::kLight, false, lost}, StopCause::kLostBurst},
      {{kReleased, BoundBy::kLight, false, number(AdviceFate::kLate)}, StopCause::kLate},
      {{kNeverAdvised, BoundBy::kLight, false, number(AdviceFate::kLostRange)}, StopCause::kLostRange},
      // No word was missed.
      {{kExpired, BoundBy::kLight}, StopCause::kExpired},
      {{kExpired, BoundBy::kLight, false, kNothingMissed, true}, StopCause::kRsuUnheard},
      {{kRsuUnheard, BoundBy::kLight}, StopCause::kRsuUnheard},
      {{kNeverAdvised, BoundBy::kLight}, StopCause::kRedWithoutAdvice},
      {{kReleased, BoundBy::kLight}, StopCause::kRedWithoutAdvice},
  };
  for (const auto& [facts, cause] : cases) {
    EXPECT_EQ(name(stop_cause(facts)), name(cause)) << name(facts.guidance) << " " << static_cast<int>(facts.bound_by);
  }
}

TEST(FateNames, AreThoseOfTheirValues) {
  EXPECT_EQ(name(AdviceFate::kApplied), "applied");
  EXPECT_EQ(name(AdviceFate::kOutOfLimit), "out_of_limit");
  EXPECT_EQ(name(AdviceFate::kDuplicate), "duplicate");
  EXPECT_EQ(name(AdviceFate::kLostPathLoss), "lost_path_loss");
  EXPECT_EQ(name(AdviceFate::kLostOutage), "lost_outage");
  EXPECT_EQ(name(AdviceFate::kNotComplied), "not_complied");
  EXPECT_EQ(name(AdviceFate::kLate), "late");
}

}  // namespace
}  // namespace lukou
