/// @file fragment_budget.h
/// How small media and particles are drawn, so that a frame does not shade more fragments than it may.
#pragma once

#include "rendering/passes/blob_instance.h"
#include "rendering/view/view_types.h"

#include <cstdint>
#include <span>

namespace fx::render {

/// [pixel] that blobs would cover one above the other at full size; every 17th is looked at.
double coveredPixels(std::span<const BlobInstance> blobs, const CameraView& camera,
                     const HostTargets& targets);

/// Rises as soon as too much is expected; falls only when the finer size would take less than two thirds of
/// the budget, so that it does not flicker between two sizes.
class FragmentBudget
{
public:
    /// @param expected fragments at full size  @param budget 0: none  @param least divisor asked for: 1, 2, 4
    /// @param isFixed always `least`
    void decide(double expected, uint64_t budget, int least, bool isFixed);

    int divisor() const { return divisor_; }
    double expected() const { return expected_; } ///< fragments at full size

private:
    int divisor_ = 1;
    double expected_ = 0.0;
};

} // namespace fx::render
