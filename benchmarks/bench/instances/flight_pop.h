/// @file flight_pop.h
/// Whether a level of detail is seen to change in a flight.
///
/// A picture that is flown through changes anyway. So each frame is drawn twice from the same place, with the
/// levels of the frame before and with its own, and what differs is a pop, beyond all that the flight itself
/// changes. Both are measured by blocks of 8 x 8 pixels, in values as a display shows them, x / (1 + x), so
/// that smoke counts beside a flame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fx::cli {

constexpr int kPopBlock = 8; ///< [pixel]

/// Largest change of a color value in each block, row by row, in display values, [0, 1].
/// @param now, before  RGBA of `width` x `height` pixels, values >= 0
std::vector<float> blockChanges(std::span<const float> now, std::span<const float> before, int width,
                                int height);

/// Gathers the frames of one flight.
class FlightPop
{
public:
    /// One frame; blocks in which nothing changes do not count.
    /// @param pops    blockChanges() from the levels of the frame before to its own
    /// @param motion  blockChanges() from the frame before to this in the flight without a level of detail
    void add(std::span<const float> pops, std::span<const float> motion);

    double largest() const;       ///< [1] pop of all blocks and frames
    double p99() const;           ///< [1] one block in a hundred has more
    double motionLargest() const; ///< [1]
    double motionP99() const;     ///< [1]

private:
    std::vector<float> pops_, motion_;
};

} // namespace fx::cli
