#include "rendering/field/field_glow_plan.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace fx::render {

namespace {

/// [exposed] mean radiance at the distance of a field's size below which its light is not seen.
constexpr float kDarkest = 1e-4f;
constexpr float kMargin =
    0.5f; ///< of a source's size, to each side: media farther away have its light as that of a point

struct Box
{
    glm::vec3 low, high; ///< [m] relative to the eye
};

Box boxOf(const FieldBlock& field)
{
    const glm::vec3 low(field.corner);
    return {low, low + field.corner.w * float(kBrickCells) * glm::vec3(field.bricks)};
}

bool overlap(const Box& a, const Box& b)
{
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

float sizeOf(const glm::vec3& extent)
{
    return std::max({extent.x, extent.y, extent.z});
}

/// [m] 2 to the power of quarters / 4.
float sideOf(float quarters)
{
    return std::exp2(0.25f * quarters);
}

/// Sides of cells are powers of 2^(1/4), so that they stay while a medium grows a little.
float quartersAbove(float side)
{
    return std::ceil(4.0f * std::log2(side));
}

/// [m] side of the smallest cells of which a box of `extent` takes no more than networkCells cubed.
float networkCellSide(const glm::vec3& extent, int networkCells)
{
    const auto fits = [&](float side) {
        const glm::vec3 count = extent / side + float(kSpareGlowCells);
        if (sizeOf(count) > float(kMaxNetworkSide))
            return false;
        const glm::ivec3 sides = networkSides(extent, side);
        return int64_t(sides.x) * sides.y * sides.z <= int64_t(networkCells) * networkCells * networkCells;
    };
    // Cells that fit in a cube around the box, then smaller ones as far as they fit around the box.
    float quarters = quartersAbove(sizeOf(extent) / float(networkCells - kSpareGlowCells));
    while (fits(sideOf(quarters - 1.0f)))
        --quarters;
    return sideOf(quarters);
}

bool gains(const MediumMoments& medium, bool had, const FieldGlowPlan::Choice& choice)
{
    const double distance = choice.orthographic ? 1.0 : glm::length(medium.center());
    return networkUse(medium, distance / double(choice.pixelsPerSlope), had) == NetworkUse::Network;
}

} // namespace

glm::ivec3 networkSides(const glm::vec3& extent, float side)
{
    const glm::vec3 rounded = glm::ceil((extent / side + float(kSpareGlowCells)) / float(kNetworkRound));
    return glm::clamp(kNetworkRound * glm::ivec3(rounded), kMinNetworkSide, kMaxNetworkSide);
}

bool FieldGlowPlan::brighter(const Source& a, const Source& b)
{
    return std::tie(a.emitted, a.low.x, a.low.y, a.low.z) > std::tie(b.emitted, b.low.x, b.low.y, b.low.z);
}

FieldGlowPlan::FieldGlowPlan(std::pmr::memory_resource* memory)
    : sources_(memory), kept_(memory), grids_(memory)
{}

void FieldGlowPlan::build(std::span<FieldBlock> ioFields, std::span<const float> emitted,
                          const glm::dvec3& eye, int networkCells, const Choice* choice)
{
    grids_.clear();
    networkCells_ = networkCells;
    for (FieldBlock& field : ioFields)
        field.limits.w = 0.0f;
    listSources(ioFields, emitted, networkCells > 0, choice);
    if (networkCells > 0)
        recallNetworks(eye);
    if (choice)
        std::erase_if(sources_,
                      [&](const Source& source) { return !gains(source.medium, source.had, *choice); });
    std::ranges::sort(sources_, brighter);
    sources_.resize(std::min(sources_.size(), kMaxGlowGrids));
    rememberNetworks(eye);
    for (const Source& source : sources_)
        placeGrid(source, ioFields, eye);
}

/// A medium is that of the last frame where the middle of one is in the box of the other.
void FieldGlowPlan::recallNetworks(const glm::dvec3& eye)
{
    const auto isWithin = [](const glm::dvec3& place, const glm::dvec3& low, const glm::dvec3& high) {
        return glm::all(glm::lessThanEqual(low, place)) && glm::all(glm::lessThanEqual(place, high));
    };
    for (Source& source : sources_) {
        const glm::dvec3 low = glm::dvec3(source.low) + eye, high = glm::dvec3(source.high) + eye;
        source.had = std::ranges::any_of(kept_, [&](const Kept& kept) {
            return isWithin(0.5 * (kept.low + kept.high), low, high) ||
                   isWithin(0.5 * (low + high), kept.low, kept.high);
        });
        if (source.had)
            source.emitted *= kNetworkPromotion * kNetworkPromotion; // an area
    }
}

void FieldGlowPlan::rememberNetworks(const glm::dvec3& eye)
{
    kept_.clear();
    if (networkCells_ > 0)
        for (const Source& source : sources_)
            kept_.push_back({glm::dvec3(source.low) + eye, glm::dvec3(source.high) + eye});
}

/// Fields that emit enough to be seen, or all; those that overlap are one.
void FieldGlowPlan::listSources(std::span<const FieldBlock> fields, std::span<const float> emitted, bool all,
                                const Choice* choice)
{
    sources_.clear();
    for (size_t f = 0; f < fields.size(); ++f) {
        const Box box = boxOf(fields[f]);
        const float size = sizeOf(box.high - box.low);
        if (!all && !(emitted[f] > kDarkest * 4.0f * std::numbers::pi_v<float> * size * size))
            continue;
        const float away = glm::length(0.5f * (box.low + box.high));
        const float seen = size * size / std::max(away * away, size * size);
        Source merged{box.low, box.high, all ? seen : emitted[f],
                      choice ? choice->media[f] : MediumMoments()};
        for (size_t s = 0; s < sources_.size();) {
            const Source& other = sources_[s];
            if (!overlap({merged.low, merged.high}, {other.low, other.high})) {
                ++s;
                continue;
            }
            merged.low = glm::min(merged.low, other.low);
            merged.high = glm::max(merged.high, other.high);
            merged.emitted += other.emitted;
            merged.medium.add(other.medium);
            sources_.erase(sources_.begin() + std::ptrdiff_t(s));
            s = 0; // what it did not reach before
        }
        sources_.push_back(merged);
    }
}

/// Around a source and the fields without a grid that overlap it, up to a margin.
void FieldGlowPlan::placeGrid(const Source& source, std::span<FieldBlock> ioFields, const glm::dvec3& eye)
{
    Box all{source.low, source.high};
    for (FieldBlock& field : ioFields) {
        const Box box = boxOf(field);
        if (field.limits.w > 0.0f || !overlap(box, {source.low, source.high}))
            continue;
        field.limits.w = float(grids_.size() + 1);
        all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
    }
    const glm::vec3 margin(kMargin * sizeOf(source.high - source.low));
    all = {glm::max(all.low, source.low - margin), glm::min(all.high, source.high + margin)};
    const glm::vec3 extent = all.high - all.low;
    const float side = networkCells_ > 0
                           ? networkCellSide(extent, networkCells_)
                           : sideOf(quartersAbove(sizeOf(extent) / float(kGlowCells - kSpareGlowCells)));
    FieldGlowBlock grid;
    grid.cells = glm::ivec4(networkCells_ > 0 ? networkSides(extent, side) : glm::ivec3(kGlowCells),
                            glowExtent(grids_).z);
    for (int a = 0; a < 3; ++a) { // in the middle of its cells, at a multiple of them
        const double first = 0.5 * double(all.low[a] + all.high[a] - float(grid.cells[a]) * side);
        grid.corner[a] = float(std::round((eye[a] + first) / double(side)) * double(side) - eye[a]);
    }
    grid.corner.w = side;
    grids_.push_back(grid);
}

} // namespace fx::render
