#include "common/measures/request_ledger.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

constexpr std::uint16_t kA = 0b0011;
constexpr std::uint16_t kB = 0b1100;

/// The controller's word on one request after the other.
class Book {
 public:
  void say(Step step, Step asked, std::uint32_t rsu, std::uint16_t lanes, RequestOutcome outcome) {
    SignalBatch batch;
    batch.request_step = {step};
    batch.request_asked = {asked};
    batch.request_rsu = {rsu};
    batch.request_lanes = {lanes};
    batch.request_outcome = {static_cast<std::uint8_t>(outcome)};
    ASSERT_TRUE(ledger_.add(batch).ok());
    for (const RequestRow& row : ledger_.rows()) rows_.push_back(row.step);
  }
  [[nodiscard]] const RequestFigures& figures() const { return ledger_.figures(); }
  [[nodiscard]] const std::vector<Step>& rows() const { return rows_; }

 private:
  RequestLedger ledger_;
  std::vector<Step> rows_;
};

TEST(RequestLedger, GivesARowWhenWhatAnRsuAsksOrItsOutcomeChanges) {
  Book book;
  book.say(1, 0, 0, kA, RequestOutcome::kAccepted);
  book.say(2, 1, 0, kA, RequestOutcome::kAccepted);
  book.say(3, 2, 0, kB, RequestOutcome::kAccepted);
  book.say(4, 3, 1, kB, RequestOutcome::kAccepted);
  book.say(5, 4, 0, kB, RequestOutcome::kMinGreen);
  book.say(6, 5, 0, kB, RequestOutcome::kMinGreen);
  EXPECT_EQ(book.rows(), (std::vector<Step>{1, 3, 4, 5}));
}

TEST(RequestLedger, CountsEachRequestOnce) {
  Book book;
  // One that is deferred, then followed, deferred again, overruled, and ends; one that is refused; one that is given
  // up.
  book.say(1, 0, 0, kA, RequestOutcome::kMinGreen);
  book.say(2, 0, 0, kA, RequestOutcome::kAccepted);
  book.say(3, 0, 0, kA, RequestOutcome::kMinGreen);
  book.say(4, 0, 0, kA, RequestOutcome::kMaxWait);
  book.say(5, 0, 0, kA, RequestOutcome::kEnded);
  book.say(6, 5, 0, kB, RequestOutcome::kConflict);
  book.say(7, 6, 1, kB, RequestOutcome::kAccepted);
  book.say(8, 6, 1, kB, RequestOutcome::kOtherRsu);
  EXPECT_EQ(book.figures().asked, 3U);
  EXPECT_EQ(book.figures().followed, 2U);
  EXPECT_EQ(book.figures().refused(), 1U);
  EXPECT_EQ(book.figures().count(RequestOutcome::kMinGreen), 1U);
  EXPECT_EQ(book.figures().count(RequestOutcome::kMaxWait), 1U);
  EXPECT_EQ(book.figures().count(RequestOutcome::kConflict), 1U);
  EXPECT_EQ(book.figures().count(RequestOutcome::kOtherRsu), 0U) << "it was followed before";
}

TEST(RequestLedger, CountsWhatAFixedPlanRefused) {
  RequestLedger ledger;
  ledger.add_fixed_plan(0);
  ledger.add_fixed_plan(2);
  EXPECT_EQ(ledger.figures().asked, 2U);
  EXPECT_EQ(ledger.figures().refused(), 2U);
  EXPECT_EQ(ledger.figures().fixed_plan, 2U);
}

TEST(RequestLedger, RefusesABrokenBatch) {
  RequestLedger ledger;
  SignalBatch batch;
  batch.request_step = {1};
  EXPECT_FALSE(ledger.add(batch).ok());
  batch.request_asked = {0};
  batch.request_rsu = {0};
  batch.request_lanes = {1};
  batch.request_outcome = {7};
  const auto unknown = ledger.add(batch);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().text(), "topic lukou/signal: a request has the unknown outcome 7");
}

}  // namespace
}  // namespace lukou
