/// @file slice_fades.h
/// Cross-fades of light slices. The sides of a stack are the side of its texels and the spacing of its
/// planes. If the extent of the media requires other sides, the stack gets new planes. For some frames, the
/// old and the new planes are sampled and mixed. Old and new planes have different errors, so a change
/// within one frame would be visible as a flash.
#pragma once

#include "rendering/lights/slices/slice_stack.h"

#include <cstddef>
#include <memory_resource>
#include <vector>

namespace fx::render {

constexpr int kFadeFrames = 16; ///< [frame] duration of a cross-fade

/// Largest planes that cross-fade. Larger planes are replaced at once, because the atlas has no room for old
/// and new planes together.
constexpr SliceResolution kMaxFadingPlanes{256, 64};

/// The sides of a stack in this frame, and the previous sides during a cross-fade.
struct SliceFade
{
    SliceFit now;
    SliceFit before;     ///< the previous sides; valid if weight > 0
    float weight = 0.0f; ///< [1] weight of the planes with the previous sides, < 1
};

/// The cross-fades of all stacks of a view. Threads: one at a time.
class SliceFades
{
public:
    explicit SliceFades(std::pmr::memory_resource* memory) : held_(memory) {}

    /// Begins a frame. @param forgets true: there are no cross-fades from the last frame
    void begin(bool forgets);
    /// Returns the sides of the next stack of the frame. Stacks must be passed in the same order in each
    /// frame.
    /// @param wanted stack that fits the casters, with snapped sides
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

    std::pmr::vector<Held> held_; ///< one element for each stack
    size_t next_ = 0;
};

} // namespace fx::render
