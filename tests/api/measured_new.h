/// @file measured_new.h
/// Measures what the whole program takes from the runtime's memory.
#pragma once

#include <cstddef>

namespace fx::test {

/// Begins anew: what is taken now is 0.
void resetMeasuredNew();
size_t largestNew(); ///< [byte] largest block since then
size_t highestNew(); ///< [byte] most that was taken at a time since then, on top of what there was

} // namespace fx::test
