#include "common/core/keyed_random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>
#include <vector>

namespace lukou {
namespace {

constexpr DrawKey kKey{.run_seed = 1, .purpose = Purpose::kTest, .entity = 4, .index = 0};

TEST(RandomBits, AreThoseOfPhiloxForTheKeyOfZeros) {
  // kat_vectors of the Random123 distribution: philox4x32 10 rounds, counter and key 0, gives
  // 6627e8d5 e169c58d bc57ac4c 9b00dbd8; the first two words are used.
  const DrawKey zeros{.run_seed = 0, .purpose = static_cast<Purpose>(0), .entity = 0, .index = 0};
  EXPECT_EQ(random_bits(zeros), 0xe169c58d6627e8d5ULL);
}

TEST(RandomBits, AreAFunctionOfTheKeyAlone) {
  const std::uint64_t first = random_bits(kKey);
  for (std::uint64_t n = 1; n < 100; ++n) {
    DrawKey other = kKey;
    other.index = n;
    static_cast<void>(random_bits(other));
  }
  EXPECT_EQ(random_bits(kKey), first);
}

TEST(RandomBits, DependOnEveryBitOfEveryPartOfTheKey) {
  std::vector<DrawKey> keys = {kKey};
  for (unsigned int bit = 0; bit < 64; ++bit) {
    DrawKey key = kKey;
    key.run_seed ^= 1ULL << bit;
    keys.push_back(key);
    key = kKey;
    key.index ^= 1ULL << bit;
    keys.push_back(key);
  }
  for (unsigned int bit = 0; bit < 32; ++bit) {
    DrawKey key = kKey;
    key.entity ^= 1U << bit;
    keys.push_back(key);
  }
  for (unsigned int bit = 0; bit < 16; ++bit) {
    DrawKey key = kKey;
    key.purpose = static_cast<Purpose>(static_cast<unsigned int>(key.purpose) ^ (1U << bit));
    keys.push_back(key);
  }
  std::set<std::uint64_t> draws;
  int flipped = 0;
  for (const DrawKey& key : keys) {
    draws.insert(random_bits(key));
    flipped += std::popcount(random_bits(key) ^ random_bits(kKey));
  }
  EXPECT_EQ(draws.size(), keys.size());
  // A changed key flips each of 64 bits with probability 1/2: over 176 keys 5632 +- 53.
  EXPECT_NEAR(flipped, 5632, 5 * 53);
}

/// Mean of n independent values.
template <class Value>
double mean(int n, Value value) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    DrawKey key = kKey;
    key.index = static_cast<std::uint64_t>(i);
    sum += value(key);
  }
  return sum / n;
}

constexpr int kDraws = 1'000'000;

TEST(Uniform01, StaysInsideTheOpenInterval) {
  for (std::uint64_t index = 0; index < 100'000; ++index) {
    DrawKey key = kKey;
    key.index = index;
    const double u = uniform01(key);
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
  }
}

TEST(Uniform01, IsTheCentreOfTheCellThatTheUpperBitsName) {
  const auto cell = static_cast<double>(random_bits(kKey) >> 12U);
  EXPECT_EQ(uniform01(kKey), (cell + 0.5) / 4503599627370496.0);  // 2^52
  // The ends: cell 0 is above 0, and the last cell's centre still is a double below 1.
  EXPECT_LT((4503599627370495.0 + 0.5) / 4503599627370496.0, 1.0);
}

TEST(Uniform01, HasTheMomentsOfTheUniformDistribution) {
  // Mean 1/2, deviation of the mean sqrt(1/12/n) = 2.9e-4; second moment 1/3, deviation sqrt(4/45/n) = 3.0e-4.
  EXPECT_NEAR(mean(kDraws, uniform01), 0.5, 5 * 2.9e-4);
  EXPECT_NEAR(mean(kDraws,
                   [](const DrawKey& key) {
                     const double u = uniform01(key);
                     return u * u;
                   }),
              1.0 / 3, 5 * 3.0e-4);
}

TEST(Uniform01, OfTwoEntitiesAreUncorrelated) {
  // The mean of the product of two independent centred values is 0, its deviation (1/12) / sqrt(n) = 8.3e-5.
  const auto product = [](const DrawKey& key) {
    DrawKey other = key;
    ++other.entity;
    return (uniform01(key) - 0.5) * (uniform01(other) - 0.5);
  };
  EXPECT_NEAR(mean(kDraws, product), 0.0, 5 * 8.3e-5);
  const auto with_next = [](const DrawKey& key) {
    DrawKey next = key;
    ++next.index;
    return (uniform01(key) - 0.5) * (uniform01(next) - 0.5);
  };
  EXPECT_NEAR(mean(kDraws, with_next), 0.0, 5 * 8.3e-5);
}

TEST(UnitExponential, HasMeanOneVarianceOneAndTheRightTail) {
  // E x = 1, E x^2 = 2, deviations of the means 1/1000 and sqrt(20)/1000; P(x > 3) = e^-3.
  EXPECT_NEAR(mean(kDraws, unit_exponential), 1.0, 5e-3);
  EXPECT_NEAR(mean(kDraws, [](const DrawKey& key) { return unit_exponential(key) * unit_exponential(key); }), 2.0,
              5 * 4.5e-3);
  EXPECT_NEAR(mean(kDraws, [](const DrawKey& key) { return unit_exponential(key) > 3.0 ? 1.0 : 0.0; }), std::exp(-3.0),
              5 * 2.2e-4);
}

TEST(StandardNormal, HasTheMomentsOfTheNormalDistribution) {
  // 0, 1, 0, 3 with variances 1, 2, 15, 96 over n.
  const auto power = [](int exponent) {
    return [exponent](const DrawKey& key) {
      double value = 1.0;
      for (int i = 0; i < exponent; ++i) value *= standard_normal(key);
      return value;
    };
  };
  EXPECT_NEAR(mean(kDraws, power(1)), 0.0, 5 * 1.0e-3);
  EXPECT_NEAR(mean(kDraws, power(2)), 1.0, 5 * 1.5e-3);
  EXPECT_NEAR(mean(kDraws, power(3)), 0.0, 5 * 3.9e-3);
  EXPECT_NEAR(mean(kDraws, power(4)), 3.0, 5 * 9.8e-3);
}

TEST(TruncatedNormal, StaysInItsInterval) {
  for (std::uint32_t entity = 0; entity < 50'000; ++entity) {
    DrawKey key = kKey;
    key.entity = entity;
    const double share = truncated_normal(key, 0.9, 0.05, 0.75, 1.0);
    ASSERT_GE(share, 0.75);
    ASSERT_LE(share, 1.0);
  }
}

TEST(TruncatedNormal, IsThePlainNormalWhereThatAlreadyLiesInside) {
  const double plain = 10.0 + 2.0 * standard_normal(kKey);
  EXPECT_EQ(truncated_normal(kKey, 10.0, 2.0, plain - 1.0, plain + 1.0), plain);
}

TEST(TruncatedNormal, UsesTheNextIndexAfterARejection) {
  // The interval excludes the first draw, or the first few: the result is the first draw that lies inside.
  const double first = standard_normal(kKey);
  const double low = first + 0.1;
  DrawKey accepted = kKey;
  while (standard_normal(accepted) < low) ++accepted.index;
  ASSERT_GT(accepted.index, 0U);
  EXPECT_EQ(truncated_normal(kKey, 0.0, 1.0, low, 100.0), standard_normal(accepted));
}

TEST(TruncatedNormal, HasTheMeanOfTheTruncatedDistribution) {
  // Mean of N(0,1) above 0: sqrt(2/pi) = 0.79788; its deviation sqrt(1 - 2/pi) = 0.603.
  double sum = 0.0;
  constexpr std::uint32_t kEntities = 200'000;
  for (std::uint32_t entity = 0; entity < kEntities; ++entity) {
    DrawKey key = kKey;
    key.entity = entity;
    sum += truncated_normal(key, 0.0, 1.0, 0.0, 100.0);
  }
  EXPECT_NEAR(sum / kEntities, 0.797884560802865, 5 * 0.603 / std::sqrt(kEntities));
}

TEST(TruncatedNormalDeathTest, GivesUpOnAnIntervalOutOfReach) {
  EXPECT_DEATH(truncated_normal(kKey, 0.0, 1.0, 50.0, 51.0), "at least 1 % of the mass");
}

}  // namespace
}  // namespace lukou
