#include "rendering/draw_order/draw_batcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace fx::render {

namespace {

constexpr uint32_t kMaxSlabs = 32;

/// First element from `begin` on that is not farther than `distance`.
uint32_t firstNotBeyond(const DrawStream& stream, uint32_t begin, float distance)
{
    uint32_t end = stream.count;
    while (begin < end) {
        const uint32_t middle = begin + (end - begin) / 2;
        if (stream.at(middle) > distance)
            begin = middle + 1;
        else
            end = middle;
    }
    return begin;
}

} // namespace

float DrawStream::at(uint32_t i) const
{
    if (!distances)
        return distance;
    const float value = distances[order[i]];
    return isSquared ? std::sqrt(value) : value;
}

/// The range in which more than one stream lies, or a little more.
DrawBatcher::Range DrawBatcher::overlapOf(std::span<const DrawStream> streams)
{
    byFar_.resize(streams.size());
    std::iota(byFar_.begin(), byFar_.end(), 0u);
    std::sort(byFar_.begin(), byFar_.end(), [&](uint32_t a, uint32_t b) {
        const float farA = streams[a].at(0);
        const float farB = streams[b].at(0);
        return farA != farB ? farA > farB : a < b;
    });
    Range overlap{1.0f, 0.0f};
    bool any = false;
    float lowestOfAll = std::numeric_limits<float>::infinity();
    float lowestCovering = lowestOfAll;
    for (const uint32_t s : byFar_) {
        const float far = streams[s].at(0);
        const float near = streams[s].at(streams[s].count - 1);
        const float lowest = streams[s].adds ? lowestCovering : lowestOfAll;
        if (lowest <= far) {
            overlap.far = any ? std::max(overlap.far, far) : far;
            overlap.near = any ? std::min(overlap.near, std::max(lowest, near)) : std::max(lowest, near);
            any = true;
        }
        lowestOfAll = std::min(lowestOfAll, near);
        if (!streams[s].adds)
            lowestCovering = std::min(lowestCovering, near);
    }
    return overlap;
}

void DrawBatcher::add(const Part& part, const DrawStream& stream)
{
    if (!batches_.empty() && batches_.back().source == stream.source &&
        batches_.back().batch == stream.batch && batches_.back().first + batches_.back().count == part.first)
        batches_.back().count += part.count;
    else
        batches_.push_back({stream.batch, part.first, part.count, stream.source});
}

/// What of each stream is farther than `edge`, or all that is left.
void DrawBatcher::takeParts(std::span<const DrawStream> streams, bool isLast, float edge)
{
    parts_.clear();
    for (uint32_t s = 0; s < streams.size(); ++s) {
        const uint32_t begin = begin_[s];
        const uint32_t end = isLast ? streams[s].count : firstNotBeyond(streams[s], begin, edge);
        if (end > begin)
            parts_.push_back({s, begin, end - begin, streams[s].at(begin + (end - begin) / 2)});
        begin_[s] = end;
    }
}

/// @param goesOn the stream that was drawn last comes first
void DrawBatcher::arrange(bool goesOn)
{
    std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
        return a.middle != b.middle ? a.middle > b.middle : a.stream < b.stream;
    });
    if (!goesOn || batches_.empty())
        return;
    const auto last =
        std::ranges::find_if(parts_, [&](const Part& part) { return part.stream == lastStream_; });
    if (last != parts_.end())
        std::rotate(parts_.begin(), last, last + 1);
}

/// @param slabs 0: every stream stays whole
void DrawBatcher::cut(std::span<const DrawStream> streams, const Range& overlap, uint32_t slabs)
{
    batches_.clear();
    begin_.assign(streams.size(), 0u);
    for (uint32_t slab = 0; slab <= slabs; ++slab) { // before the first and behind the last nothing overlaps
        const bool isLast = slabs == 0;
        const float share = isLast ? 1.0f : float(slab) / float(slabs);
        takeParts(streams, isLast, overlap.far + (overlap.near - overlap.far) * share);
        arrange(slab > 0);
        for (const Part& part : parts_) {
            add(part, streams[part.stream]);
            lastStream_ = part.stream;
        }
    }
    takeParts(streams, true, 0.0f);
    arrange(false);
    for (const Part& part : parts_)
        add(part, streams[part.stream]);
}

std::span<const DrawBatch> DrawBatcher::build(std::span<const DrawStream> streams)
{
    const Range overlap = overlapOf(streams);
    uint32_t slabs = overlap.near > overlap.far ? 0 : kMaxSlabs;
    cut(streams, overlap, slabs);
    while (slabs > 0 && batches_.size() > kMaxBatches) {
        slabs = std::min(slabs - 1, uint32_t(uint64_t(slabs) * kMaxBatches / batches_.size()));
        cut(streams, overlap, slabs);
    }
    return batches_;
}

} // namespace fx::render
