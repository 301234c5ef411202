#include "rendering/view/layer_scale_control.h"

#include "rendering/frame/fragment_counts.h"

#include <algorithm>

namespace fx::render {

size_t layerDivisorIndex(int divisor)
{
    return divisor >= 4 ? 2 : (divisor >= 2 ? 1 : 0);
}

int LayerScaleControl::choose(const std::array<uint64_t, 3>& estimates, int askedDivisor, uint64_t budget,
                              bool reset)
{
    const size_t asked = layerDivisorIndex(askedDivisor);
    size_t needed = asked;
    while (budget > 0 && needed + 1 < kLayerDivisors.size() && estimates[needed] > budget)
        ++needed;

    if (budget == 0 || reset || needed > index_ || index_ < asked) {
        calmFrames_ = 0;
        index_ = needed;
        return kLayerDivisors[index_];
    }
    const bool isCalm = index_ > asked && double(estimates[index_ - 1]) <= kRoom * double(budget);
    calmFrames_ = isCalm ? calmFrames_ + 1 : 0;
    if (calmFrames_ >= kCalmFrames) {
        calmFrames_ = 0;
        --index_;
    }
    return kLayerDivisors[index_];
}

} // namespace fx::render
