#include "services/rsu/algorithms/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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
  const auto made = make_algorithm("green_wave", {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().text().find("did you mean"), std::string::npos);
  EXPECT_NE(made.error().text().find(
                "actuated, arrive_on_green, cv_phase, eco, glosa, glosa_queue, max_pressure, none, platoon"),
            std::string::npos);
}

TEST(AlgorithmRegistry, SaysWhatEachIsAndWhereItComesFrom) {
  ASSERT_EQ(algorithm_docs().size(), algorithm_names().size());
  for (const AlgorithmDoc& doc : algorithm_docs()) {
    EXPECT_FALSE(doc.what.empty()) << doc.name;
    EXPECT_FALSE(doc.source.empty()) << doc.name;
  }
  EXPECT_TRUE(std::ranges::is_sorted(algorithm_names()));
}

TEST(AlgorithmRegistry, DoesNotTakeGlosaForTheOneWithAQueue) {
  const AlgorithmParameters parameters;
  EXPECT_FALSE(parameters.glosa.queue);
  EXPECT_TRUE(parameters.glosa_queue.queue);
}

}  // namespace
}  // namespace lukou
