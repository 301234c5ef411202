#include "rendering/lights/slices/slice_fades.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr float kStep = 1.0f / float(kFadeFrames);
constexpr float kNear = 1.5f; ///< ratio of sides that are mixed: planes that are far off would miss the media

} // namespace

void SliceFades::begin(bool forgets)
{
    if (forgets)
        held_.clear();
    else
        held_.resize(std::min(held_.size(), next_)); // stacks that the last frame did not have
    next_ = 0;
}

bool SliceFades::isNear(const Sides& a, const Sides& b)
{
    const auto near = [](float x, float y) { return x < kNear * y && y < kNear * x; };
    return near(a.texel, b.texel) && near(a.spacing, b.spacing);
}

SliceFade SliceFades::next(const SliceStack& wanted)
{
    const Sides sides{wanted.texel, wanted.spacing};
    if (next_ == held_.size())
        held_.push_back({sides, sides, 0.0f});
    Held& held = held_[next_++];
    held.weight = std::max(held.weight - kStep, 0.0f);
    const bool canFade = wanted.resolution.texels <= kMaxFadingPlanes.texels &&
                         wanted.resolution.planes <= kMaxFadingPlanes.planes;
    if (!canFade || !isNear(sides, held.now)) {
        held = {sides, sides, 0.0f};
    } else if (sides != held.now && held.weight == 0.0f) {
        held = {sides, held.now, 1.0f - kStep};
    } else if (sides != held.now && sides == held.before) { // back again
        held = {sides, held.now, 1.0f - held.weight};
    } // otherwise what fades goes on, even if other sides are wanted by now
    return {{true, held.now.texel, held.now.spacing},
            {true, held.before.texel, held.before.spacing},
            held.weight};
}

} // namespace fx::render
