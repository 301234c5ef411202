#include "rendering/reference/render/seen_outputs.h"

#include "rendering/reference/render/chord_depth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

void addShare(std::vector<InstanceShare>& io, uint64_t instance, double share)
{
    const auto found = std::ranges::find(io, instance, &InstanceShare::instance);
    if (found == io.end())
        io.push_back({instance, share});
    else
        found->share += share;
}

double SeenOutputs::depthTo(double place) const
{
    if (detailed_)
        return detailed_->opticalDepth(begin_, place);
    double sum = 0.0;
    for (const BlobChord& chord : chords_)
        sum += chord.opticalDepth(begin_, place);
    return sum;
}

double SeenOutputs::firstDepth() const
{
    if (whole_ < kSeenDepth)
        return std::numeric_limits<double>::infinity();
    double low = begin_, high = end_;
    for (int i = 0; i < 60 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        (depthTo(middle) < kSeenDepth ? low : high) = middle;
    }
    return high;
}

void SeenOutputs::fillSteps()
{
    const double step = (end_ - begin_) / kSteps;
    const size_t count = chords_.size();
    depths_.assign(count * kSteps, 0.0);
    for (int k = 0; k < kSteps; ++k) {
        const double from = begin_ + k * step, to = begin_ + (k + 1) * step;
        double* const own = &depths_[size_t(k) * count];
        for (size_t i = 0; i < count; ++i)
            own[i] = chords_[i].opticalDepth(from, to);
        if (!detailed_)
            continue;
        detailed_->look(0.5 * (from + to));
        double sum = 0.0;
        for (size_t i = 0; i < count; ++i)
            sum += own[i] *= detailed_->share(i);
        const double whole = detailed_->opticalDepth(from, to);
        for (size_t i = 0; i < count; ++i)
            own[i] = sum > 0.0 ? own[i] * whole / sum : 0.0;
    }
}

void SeenOutputs::weigh()
{
    const double step = (end_ - begin_) / kSteps;
    const size_t count = chords_.size();
    shares_.assign(count, 0.0);
    moments_.assign(count, 0.0);
    double passed = 0.0;
    for (int k = 0; k < kSteps; ++k) {
        const double* const own = &depths_[size_t(k) * count];
        double depth = 0.0;
        for (size_t i = 0; i < count; ++i)
            depth += own[i];
        if (depth > 0.0) {
            const double weight = std::exp(-passed) * -std::expm1(-depth) / depth;
            for (size_t i = 0; i < count; ++i) {
                shares_[i] += weight * own[i];
                moments_[i] += weight * own[i] * (begin_ + (k + 0.5) * step);
            }
        }
        passed += depth;
    }
}

glm::dvec2 SeenOutputs::windowBefore(const glm::dvec3& place) const
{
    const ReferenceCamera& c = past_.camera;
    const double depth = c.orthographic ? 1.0 : std::max(glm::dot(place, c.forward), 1e-6);
    const double high = c.halfHeight * depth, wide = high * width_ / height_;
    return {0.5 * width_ * (1.0 + glm::dot(place, c.right) / wide),
            0.5 * height_ * (1.0 + glm::dot(place, c.up) / high)};
}

SeenOutputs::Seen SeenOutputs::along(const TraceRay& ray, const RayHits& hits, double begin, double end,
                                     DetailedRay* detailed, const glm::dvec2& window,
                                     std::vector<InstanceShare>& ioShares)
{
    Seen seen;
    detailed_ = detailed;
    chords_.clear();
    begin_ = std::numeric_limits<double>::infinity();
    end_ = -begin_;
    for (size_t i = 0; i < hits.size(); ++i) {
        chords_.emplace_back(medium_.blob(hits.place[i]), hits, i);
        begin_ = std::min(begin_, hits.enter[i]);
        end_ = std::max(end_, 2.0 * hits.nearest[i] - hits.enter[i]);
    }
    begin_ = std::max(begin_, begin);
    end_ = std::min(end_, end);
    if (!(end_ > begin_))
        return seen;
    whole_ = depthTo(end_);
    seen.first = firstDepth();
    fillSteps();
    weigh();
    for (size_t i = 0; i < chords_.size(); ++i) {
        if (!(shares_[i] > 0.0))
            continue;
        const MediumView::Track& track = medium_.track(hits.place[i]);
        const glm::dvec3 place = ray.origin + ray.direction * (moments_[i] / shares_[i]);
        const glm::dvec3 before = moved_ + place - past_.seconds * track.velocity;
        seen.motion += shares_[i] * (window - windowBefore(before));
        seen.share += shares_[i];
        addShare(ioShares, track.instance, shares_[i]);
    }
    return seen;
}

} // namespace fx::render
