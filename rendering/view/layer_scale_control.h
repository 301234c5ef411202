/// @file layer_scale_control.h
/// Chooses the size of the layers so that a frame keeps its budget of fragments, without flicker.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fx::render {

/// Smaller at once when a frame would be too dear; larger again only one step at a time, after kCalmFrames
/// frames in a row that would have been affordable with room to spare at the next size.
class LayerScaleControl
{
public:
    static constexpr uint32_t kCalmFrames = 30;
    static constexpr double kRoom = 0.8; ///< [1] share of the budget that a larger size may take

    /// @param estimates fragments of this frame at each of kLayerDivisors
    /// @param askedDivisor one of kLayerDivisors; the result is never less
    /// @param budget [fragment]; 0: none, the result is askedDivisor
    /// @param reset a cut: the past does not count
    /// @return the divisor of this frame
    int choose(const std::array<uint64_t, 3>& estimates, int askedDivisor, uint64_t budget, bool reset);

private:
    size_t index_ = 0; ///< of kLayerDivisors
    uint32_t calmFrames_ = 0;
};

/// Place of `divisor` in kLayerDivisors.
size_t layerDivisorIndex(int divisor);

} // namespace fx::render
