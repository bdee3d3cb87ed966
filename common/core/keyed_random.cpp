#include "common/core/keyed_random.hpp"

#include <Random123/philox.h>

#include "common/core/contract.hpp"
#include "common/core/math.hpp"

namespace lukou {

std::uint64_t random_bits(const DrawKey& key) {
  using Philox = r123::Philox4x32;
  const Philox::ctr_type counter = {{static_cast<std::uint32_t>(key.index),
                                     static_cast<std::uint32_t>(key.index >> 32U), key.entity,
                                     static_cast<std::uint32_t>(key.purpose)}};
  const Philox::key_type philox_key = {
      {static_cast<std::uint32_t>(key.run_seed), static_cast<std::uint32_t>(key.run_seed >> 32U)}};
  const auto block = Philox{}(counter, philox_key);
  return static_cast<std::uint64_t>(block[0]) | (static_cast<std::uint64_t>(block[1]) << 32U);
}

double uniform01(const DrawKey& key) {
  // 52 bits, centred in their cells: never 0, never 1.
  return (static_cast<double>(random_bits(key) >> 12U) + 0.5) * 0x1.0p-52;
}

double unit_exponential(const DrawKey& key) { return -math::log(uniform01(key)); }

double standard_normal(const DrawKey& key) { return math::normal_quantile(uniform01(key)); }

double truncated_normal(const DrawKey& key, double mean, double deviation, double low, double high) {
  DrawKey attempt = key;
  for (int n = 0; n < 10000; ++n, ++attempt.index) {
    const double value = mean + deviation * standard_normal(attempt);
    if (value >= low && value <= high) return value;
  }
  contract_violated("truncated_normal: the interval holds at least 1 % of the mass", __FILE__, __LINE__);
}

}  // namespace lukou
