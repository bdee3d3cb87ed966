#include "common/core/contract.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

TEST(ContractDeathTest, EndsTheProgramWithTheConditionAndItsPlaceInEveryBuild) {
  const int cars = 3;
  EXPECT_DEATH(LUKOU_EXPECT(cars < 2), "internal error: cars < 2 does not hold .*contract_test\\.cpp:[0-9]+");
}

TEST(Contract, EvaluatesTheConditionOnceAndGoesOnIfItHolds) {
  int evaluated = 0;
  LUKOU_EXPECT(++evaluated == 1);
  EXPECT_EQ(evaluated, 1);
}

}  // namespace
}  // namespace lukou
