#include "common/core/contract.hpp"

#include <cstdio>
#include <cstdlib>

namespace lukou {

void contract_violated(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "lukou: internal error: %s does not hold (%s:%d)\n", condition, file, line);
  std::abort();
}

}  // namespace lukou
