#include "rendering/lod/stochastic_simplification.h"

#include "foundation/snapshot/particle_kind.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/packing.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr uint64_t kStripNumber = (uint64_t(1) << 40) - 1; ///< above it, merged groups tell effects apart
constexpr float kMaxOpacity = 60'000.0f;                   ///< [1] factor that a binary16 can hold

bool isStrip(RowShape shape)
{
    return shape == RowShape::Strip || shape == RowShape::SolidStrip;
}

} // namespace

DrawnRows countDrawn(const base::SnapshotGroup& group, uint32_t first, uint32_t count, bool isRibbon)
{
    DrawnRows drawn;
    if (!isRibbon) {
        const float* radius = group.column(base::particle_column::Radius).data() + first;
        for (uint32_t i = 0; i < count; ++i)
            drawn.pieces += radius[i] > 0.0f ? 1 : 0;
        drawn.wholes = drawn.pieces;
        return drawn;
    }
    const auto strips = group.column64(base::ribbon_column::Strip).subspan(first, count);
    for (uint32_t i = 0; i < count; ++i)
        (i + 1 < count && strips[i] == strips[i + 1] ? drawn.pieces : drawn.wholes) += 1;
    return drawn;
}

namespace {

/// The rows of one effect.
class PartSimplification
{
public:
    PartSimplification(const SimplificationInputs& in, const RowPart& part, const base::Placement& place)
        : in_(in), part_(part), drawn_(countDrawn(*in.rows, part.first, part.count, isStrip(in.shape)))
    {
        const base::Bounds& bounds = part.info.bounds;
        const glm::vec3 middle = bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
        const glm::vec3 center = glm::vec3(place.position) + place.rotation * (middle * place.scale);
        const float distance = in.camera->orthographic ? 1.0f : std::max(glm::length(center), 1e-6f);
        pixelsPerMetre_ = in.place.scale * in.pixelsPerSlope / distance; // of the group's own metres
    }

    bool choose(LevelOfDetail& lod, const base::Placement& place)
    {
        level_ = lod.levelOfRows(part_.info, place, drawn_.pieces, drawn_.wholes);
        return !level_.ramp.isAll();
    }

    /// @return what is left out
    uint64_t write(std::span<uint32_t> factors) const
    {
        if (isStrip(in_.shape))
            return writeStrips(factors);
        const float* radius = in_.rows->column(base::particle_column::Radius).data() + part_.first;
        uint32_t kept = 0;
        for (uint32_t i = 0; i < part_.count; ++i) {
            factors[i] = radius[i] > 0.0f ? pack(birthRank(i), radius[i]) : 0u;
            kept += factors[i] != 0 ? 1 : 0;
        }
        return drawn_.pieces - kept;
    }

private:
    uint32_t pack(float rank, float radius) const
    {
        const RowFactors factors = rowFactors(level_, rank, radius * pixelsPerMetre_, in_.shape);
        if (factors.size * factors.opacity == 0.0f)
            return 0;
        return glm::packHalf2x16({factors.size, std::min(factors.opacity, kMaxOpacity)});
    }

    uint64_t writeStrips(std::span<uint32_t> factors) const
    {
        const auto strips = in_.rows->column64(base::ribbon_column::Strip).subspan(part_.first, part_.count);
        const float* widths = in_.rows->column(base::ribbon_column::HalfWidth).data() + part_.first;
        uint32_t kept = 0;
        for (uint32_t begin = 0, end = 0; begin < part_.count; begin = end) {
            float widest = 0.0f;
            for (end = begin; end < part_.count && strips[end] == strips[begin]; ++end)
                widest = std::max(widest, widths[end]);
            const uint32_t packed = pack(birthRank(strips[begin] & kStripNumber), widest);
            for (uint32_t i = begin; i < end; ++i)
                factors[i] = i + 1 < end ? packed : 0u; // the last point begins no piece
            kept += packed != 0 ? end - begin - 1 : 0;
        }
        return drawn_.pieces - kept;
    }

    const SimplificationInputs& in_;
    const RowPart& part_;
    DrawnRows drawn_;
    float pixelsPerMetre_ = 1.0f;
    LodLevel level_;
};

/// An effect that is part of a merged group stands where the newer snapshot has it.
base::Placement placeOf(const SimplificationInputs& in, const RowPart& part)
{
    base::Placement place = part.info.placement;
    place.position -= in.camera->eye;
    return in.parts.empty() ? in.place : place;
}

} // namespace

RowFactors rowFactors(const LodLevel& level, float rank, float pixels, RowShape shape)
{
    if (level.ramp.isAll())
        return {1.0f, 1.0f};
    const float weight = level.ramp.weight(rank);
    const float mean = level.ramp.mean();
    const float most =
        pixels > 0.0f
            ? std::max(1.0f, std::min(level.grownPixels / pixels, 1.0f + level.swollenPixels / pixels))
            : 1.0f;
    if (isStrip(shape)) {
        const float size = std::min(1.0f / mean, most);
        return shape == RowShape::Strip ? RowFactors{size, weight / (mean * size)} // (3)
                                        : RowFactors{size * weight, 1.0f};         // (4)
    }
    const float size = std::min(1.0f / std::sqrt(mean), most);
    return shape == RowShape::Card ? RowFactors{size, weight / (mean * size * size)} // (3)
                                   : RowFactors{size * std::sqrt(weight), 1.0f};     // (4)
}

bool simplifyRows(const SimplificationInputs& in, LevelOfDetail& lod, std::pmr::vector<uint32_t>& outFactors,
                  uint64_t& ioLeftOut)
{
    const RowPart whole{in.rows->info(), 0, in.rows->count()};
    const std::span<const RowPart> parts = in.parts.empty() ? std::span(&whole, 1) : in.parts;
    bool isChanged = false;
    for (const RowPart& part : parts) {
        const base::Placement place = placeOf(in, part);
        PartSimplification simplification(in, part, place);
        const bool changes = simplification.choose(lod, place);
        if (changes && !isChanged) {
            outFactors.resize(in.rows->count());
            std::fill_n(outFactors.begin(), part.first, glm::packHalf2x16({1.0f, 1.0f})); // nothing so far
            isChanged = true;
        }
        if (isChanged)
            ioLeftOut += simplification.write(std::span(outFactors).subspan(part.first, part.count));
    }
    return isChanged;
}

} // namespace fx::render
