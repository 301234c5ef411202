/// @file flight_pop.h
/// Visibility of changes of the level of detail (popping) in a flight. The picture changes with the camera
/// anyway. Therefore each frame is drawn twice from the same camera: first with the levels of detail of the
/// previous frame, then with those of this frame. The difference of both pictures is the pop. Changes are
/// measured in blocks of 8 x 8 pixels, in display values x / (1 + x), so that smoke has weight beside a
/// flame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fx::cli {

constexpr int kPopBlock = 8; ///< [pixel]

/// Largest change of a color value in each block, row by row, in display values, [0, 1].
/// @param now, before RGBA of `width` x `height` pixels, values >= 0
std::vector<float> blockChanges(std::span<const float> now, std::span<const float> before, int width,
                                int height);

/// Collects the frames of one flight.
class FlightPop
{
public:
    /// Adds one frame; blocks without change are ignored.
    /// @param pops blockChanges() between the pictures with the previous levels and with the frame's own
    ///          levels
    /// @param motion blockChanges() from the previous frame in the flight without levels of detail
    void add(std::span<const float> pops, std::span<const float> motion);

    double largest() const;       ///< [1] largest pop of all blocks and frames
    double p99() const;           ///< [1] 99th percentile of pops
    double motionLargest() const; ///< [1]
    double motionP99() const;     ///< [1]

private:
    std::vector<float> pops_, motion_;
};

} // namespace fx::cli
