/// @file layer_scale_control.h
/// Chooses the size of layers so that a frame stays within its budget of fragments, without flicker.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fx::render {

/// If a frame would exceed the budget, layers become smaller at once. Layers become larger one step at a
/// time. A step requires kCalmFrames successive frames whose estimate at the next larger size is at most
/// kRoom times the budget.
class LayerScaleControl
{
public:
    static constexpr uint32_t kCalmFrames = 30;
    static constexpr double kRoom =
        0.8; ///< [1] largest estimate for which layers become larger, divided by the budget

    /// Chooses the divisor of layers for a frame.
    /// @param estimates estimated fragments of this frame for each of kLayerDivisors
    /// @param askedDivisor one of kLayerDivisors; the result is never less
    /// @param budget [fragment] 0: no budget, so that the result is askedDivisor
    /// @param reset true: the camera has jumped, so that earlier frames are ignored
    /// @return the divisor of layers in this frame
    int choose(const std::array<uint64_t, 3>& estimates, int askedDivisor, uint64_t budget, bool reset);

private:
    size_t index_ = 0; ///< index in kLayerDivisors
    uint32_t calmFrames_ = 0;
};

/// Index of `divisor` in kLayerDivisors.
size_t layerDivisorIndex(int divisor);

} // namespace fx::render
