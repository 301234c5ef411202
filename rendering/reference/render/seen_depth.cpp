#include "rendering/reference/render/seen_depth.h"

#include "rendering/reference/render/chord_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::render {

namespace {

/// The first step whose middle lies at or behind `place`, which is counted in steps.
int stepAfter(double place)
{
    return int(std::clamp(std::ceil(place - 0.5), 0.0, double(SeenDepth::kSteps)));
}

} // namespace

MediumDepth SeenDepth::along(const MediumView& medium, const RayHits& hits, double begin, double end)
{
    const double none = std::numeric_limits<double>::infinity();
    double a = none;
    double b = -none;
    for (size_t i = 0; i < hits.size(); ++i) {
        a = std::min(a, hits.enter[i]);
        b = std::max(b, 2.0 * hits.nearest[i] - hits.enter[i]);
    }
    a = std::max(a, begin);
    b = std::min(b, end);
    if (!(b > a))
        return {none, 0.0};
    const double step = (b - a) / kSteps;
    if (!(step > 0.0)) // less than the least number
        return {none, 0.0};
    depth_.fill(0.0);
    passed_.fill(0.0);
    double whole = 0.0;
    for (size_t i = 0; i < hits.size(); ++i) {
        const BlobChord chord(medium.blob(hits.place[i]), hits, i);
        const double all = chord.opticalDepth(a, b);
        const int first = stepAfter((hits.enter[i] - a) / step);
        const int last = stepAfter((2.0 * hits.nearest[i] - hits.enter[i] - a) / step);
        for (int k = first; k < last; ++k)
            depth_[size_t(k)] += chord.opticalDepth(a, a + (k + 0.5) * step);
        passed_[size_t(last)] += all;
        whole += all;
    }
    const double opacity = -std::expm1(-whole);
    if (!(opacity > 0.0))
        return {none, whole};
    double sum = 0.0;
    double passed = 0.0;
    for (size_t k = 0; k < depth_.size(); ++k) {
        passed += passed_[k];
        sum -= std::expm1(-(passed + depth_[k]));
    }
    return {b - sum * step / opacity, whole}; // (3)
}

} // namespace fx::render
