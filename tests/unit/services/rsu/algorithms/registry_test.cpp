#include "services/rsu/algorithms/registry.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

TEST(AlgorithmRegistry, MakesEveryAlgorithmThatItNames) {
  for (const auto name : algorithm_names()) {
    const auto made = make_algorithm(name, {});
    ASSERT_TRUE(made) << name;
    EXPECT_NE(made.value(), nullptr);
  }
}

TEST(AlgorithmRegistry, SaysWhatWasMeantForASlip) {
  const auto made = make_algorithm("arive_on_green", {});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().text().find("did you mean \"arrive_on_green\"?"), std::string::npos);
}

TEST(AlgorithmRegistry, NamesAllForAWordThatIsNearToNone) {
  const auto made = make_algorithm("max_pressure", {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().text().find("did you mean"), std::string::npos);
  EXPECT_NE(made.error().text().find("arrive_on_green, none"), std::string::npos);
}

}  // namespace
}  // namespace lukou
