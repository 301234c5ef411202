#include "simulation/volume/sequence_solver.h"

#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "simulation/solver/sequence_player.h"
#include "simulation/volume/brick_balls.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fx::sim {
namespace {

/// [1] Share of a cross section that balls keep whose frame is not shown now, but was shown in this step:
/// renderers need them to find the bricks.
constexpr float kLeastShare = 1e-6f;

BrickPlace placeOf(const SequenceDef& def)
{
    return {def, def.sequence->origin(), def.sequence->side()};
}

bool isBefore(const base::VolumeCells& a, const base::VolumeCells& b)
{
    return std::tuple(a.brick.z, a.brick.y, a.brick.x) < std::tuple(b.brick.z, b.brick.y, b.brick.x);
}

/// A frame and its share of what is shown.
struct Part
{
    uint32_t frame;
    float share;
};

/// Adds to cells the share of others of the same brick.
void blendInto(base::VolumeCells& io, const base::VolumeCells& more, float share)
{
    const float own = share * more.crossSection, sum = io.crossSection + own;
    const float part = sum > 0.0f ? own / sum : 0.0f;
    io.crossSection = sum;
    io.temperature += part * (more.temperature - io.temperature);
    io.albedo += part * (more.albedo - io.albedo);
    io.emission += part * (more.emission - io.emission);
}

/// Cells of all bricks of a few frames, blended, in the order of VolumeCells.
std::vector<base::VolumeCells> blend(const base::VolumeSequence& sequence, std::span<const Part> parts)
{
    std::vector<base::VolumeCells> out;
    std::vector<size_t> at(parts.size());
    for (;;) {
        const base::VolumeCells* first = nullptr;
        for (size_t p = 0; p < parts.size(); ++p) {
            const std::vector<base::VolumeCells>& cells = sequence.cells(parts[p].frame);
            if (at[p] < cells.size() && (!first || isBefore(cells[at[p]], *first)))
                first = &cells[at[p]];
        }
        if (!first)
            return out;
        base::VolumeCells& io = out.emplace_back();
        io.brick = first->brick;
        for (size_t p = 0; p < parts.size(); ++p) {
            const std::vector<base::VolumeCells>& cells = sequence.cells(parts[p].frame);
            if (at[p] < cells.size() && cells[at[p]].brick == io.brick)
                blendInto(io, cells[at[p]++], std::max(parts[p].share, kLeastShare));
        }
    }
}

/// All frames from `before` to `frame`, of which the two around `frame` have a share.
/// @param before at most `frame`; may be negative, see volume_constant
std::vector<Part> partsOf(double before, double frame, uint32_t count)
{
    const auto first = int64_t(std::floor(before)), shown = int64_t(std::floor(frame));
    const auto part = float(frame - double(shown));
    const int64_t last = part > 0.0f ? shown + 1 : shown;
    std::vector<Part> parts;
    for (int64_t i = std::max(first, last - int64_t(count) + 1); i <= last; ++i)
        parts.push_back({uint32_t((i + 2 * int64_t(count)) % int64_t(count)), i == shown       ? 1.0f - part
                                                                              : i == shown + 1 ? part
                                                                                               : 0.0f});
    return parts;
}

class SequenceSolver final : public SequencePlayer
{
public:
    SequenceSolver(const SequenceDef& def, const base::SnapshotSchema& schema)
        : SequencePlayer(def.time()), def_(def), kinds_(schema)
    {}

    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        if (kinds_.blobs == base::kNoKind)
            return;
        const uint32_t count = def_.sequence->count();
        double before = def_.frameAt(now() - snapshot.step());
        if (before > frame())
            before -= double(count);
        const std::vector<base::VolumeCells> cells = blend(*def_.sequence, partsOf(before, frame(), count));
        BrickBalls{def_,
                   placeOf(def_),
                   cells,
                   std::max(def_.capacity(), uint32_t(cells.size())),
                   def_.asset,
                   def_.detail,
                   float(frame()),
                   float(before),
                   1.0f / def_.framesPerSecond}
            .publish(base, kinds_, snapshot);
    }

    uint32_t elementCount() const override
    {
        return uint32_t(def_.sequence->cells(uint32_t(frame())).size());
    }

private:
    const SequenceDef& def_;
    VolumeKinds kinds_;
};

} // namespace

void SequenceDef::setSequence(std::shared_ptr<base::VolumeSequence> frames)
{
    sequence = std::move(frames);
    mostCells = 0;
    const uint32_t count = sequence->count();
    for (uint32_t i = 0; i < count; ++i) // a step begins and ends between frames
        mostCells = std::max(mostCells, uint32_t(blend(*sequence, partsOf(i, i + 1.5, count)).size()));
}

std::unique_ptr<Solver> SequenceDef::create(const base::SnapshotSchema& schema, const Quality&,
                                            std::pmr::memory_resource*) const
{
    return std::make_unique<SequenceSolver>(*this, schema);
}

bool SequenceDef::publishes(const base::KindDesc& kind) const
{
    return kind == base::kBlobKind || kind == base::kVolumeKind ||
           (detail.given && kind == base::kMaterialKind);
}

uint64_t SequenceDef::bytes() const
{
    if (!sequence)
        return 0;
    uint64_t cells = 0, voxels = 0;
    for (uint32_t i = 0; i < sequence->count(); ++i) {
        cells += sequence->cells(i).size() * sizeof(base::VolumeCells);
        voxels += sequence->bytes(i);
    }
    return cells + std::min(voxels, sequence->memory()) +
           (detail.given ? capacity() * kBrickMaterialBytes : 0);
}

float SequenceDef::reach(float, float, float) const
{
    float farthest = 0.0f;
    for (uint32_t i = 0; sequence && i < sequence->count(); ++i)
        for (const base::VolumeCells& own : sequence->cells(i))
            farthest = std::max(farthest, placeOf(*this).reachOf(own.brick));
    return farthest;
}

} // namespace fx::sim
