#include "tests/fuzz/fuzz_target.h"

#include <cstdio>
#include <cstdlib>

namespace fx::fuzz {

void require(bool holds, const char* promise, std::string_view detail)
{
    if (holds)
        return;
    std::fprintf(stderr, "broken promise: %s: %.*s\n", promise, int(detail.size()), detail.data());
    std::abort();
}

} // namespace fx::fuzz
