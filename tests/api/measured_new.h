/// @file measured_new.h
/// Measures the memory that the whole program allocates by operator new.
#pragma once

#include <cstddef>

namespace fx::test {

/// Restarts the measurement at 0.
void resetMeasuredNew();
size_t largestNew(); ///< [byte] largest block since the restart
size_t
highestNew(); ///< [byte] largest total size of blocks since the restart, minus the total at the restart

} // namespace fx::test
