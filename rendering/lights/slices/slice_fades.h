/// @file slice_fades.h
/// Which sides the stacks of a view have while they change: a stack that the media outgrow, or that has
/// become too large for them, gets the next sides, and for some frames both are looked up and mixed. Another
/// lattice errs elsewhere, so that a change within one frame would be seen as a flash.
#pragma once

#include "rendering/lights/slices/slice_stack.h"

#include <cstddef>
#include <memory_resource>
#include <vector>

namespace fx::render {

constexpr int kFadeFrames = 16; ///< in which new planes take over

/// Planes above these are replaced at once: those before would not fit into the atlas beside them.
constexpr SliceResolution kMaxFadingPlanes{256, 64};

/// How a stack is to be made.
struct SliceFade
{
    SliceFit now;
    SliceFit before;     ///< only with weight > 0
    float weight = 0.0f; ///< [1] < 1, weight of the previous planes
};

/// Threads: one at a time.
class SliceFades
{
public:
    explicit SliceFades(std::pmr::memory_resource* memory) : held_(memory) {}

    /// Begins a frame. @param forgets the picture is unrelated to the last frame
    void begin(bool forgets);
    /// Returns the fade of the next stack of the frame. Stacks must be passed in the same order in each
    /// frame.
    /// @param wanted as the casters need it, snapped
    SliceFade next(const SliceStack& wanted);

private:
    struct Sides
    {
        float texel, spacing;
        bool operator==(const Sides&) const = default;
    };
    struct Held
    {
        Sides now, before;
        float weight;
    };
    static bool isNear(const Sides& a, const Sides& b);

    std::pmr::vector<Held> held_; ///< of each stack
    size_t next_ = 0;
};

} // namespace fx::render
