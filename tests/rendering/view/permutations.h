/// @file permutations.h
/// Number of random orders in which a test draws.
#pragma once

#include <cstdlib>

namespace fx::test {

/// Number of random orders: 40, or 1000 if the environment variable FXSDK_LONG_RUN is set.
inline int permutations()
{
    return std::getenv("FXSDK_LONG_RUN") ? 1000 : 40;
}

} // namespace fx::test
