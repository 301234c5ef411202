#include "simulation/volume/sequence_solver.h"

#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "simulation/solver/sequence_player.h"
#include "simulation/volume/brick_balls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace fx::sim {
namespace {

/// [1] Share of a cross section that balls keep whose frame is not shown now, but was shown in this step:
/// renderers need them to find the bricks.
constexpr float kLeastShare = 1e-6f;

/// [1] Frames nearer to a whole number are that frame.
constexpr double kWhole = 1e-6;

BrickPlace placeOf(const SequenceDef& def, uint32_t lattice)
{
    const base::VolumeLattice own = def.sequence->lattice(lattice);
    return {def, glm::vec3(own.origin), float(own.side)};
}

/// A frame and its share of what is shown.
struct Part
{
    uint32_t frame;
    float share;
};

/// Cells of several frames on one lattice, blended, in the order of VolumeCells.
std::vector<base::VolumeCells> blend(std::span<const Part> parts,
                                     std::span<const std::vector<base::VolumeCells>* const> cellsOf)
{
    std::vector<base::VolumeCells> out;
    std::vector<size_t> at(parts.size());
    for (;;) {
        const base::VolumeCells* first = nullptr;
        for (size_t p = 0; p < parts.size(); ++p) {
            const std::vector<base::VolumeCells>& cells = *cellsOf[p];
            if (at[p] < cells.size() && (!first || base::isBefore(cells[at[p]].brick, first->brick)))
                first = &cells[at[p]];
        }
        if (!first)
            return out;
        base::VolumeCells& io = out.emplace_back();
        io.brick = first->brick;
        for (size_t p = 0; p < parts.size(); ++p) {
            const std::vector<base::VolumeCells>& cells = *cellsOf[p];
            if (at[p] < cells.size() && cells[at[p]].brick == io.brick)
                base::blendInto(io, cells[at[p]++], std::max(parts[p].share, kLeastShare));
        }
    }
}

/// All frames from `before` to `frame`, of which the two around `frame` have a share.
/// @param before at least 0  @param frame at least `before`; of a loop, may be `count` and above
std::vector<Part> partsOf(double before, double frame, uint32_t count)
{
    const auto first = int64_t(std::floor(before)), shown = int64_t(std::floor(frame));
    const auto part = float(frame - double(shown));
    const int64_t last = part > 0.0f ? shown + 1 : shown;
    std::vector<Part> parts;
    for (int64_t i = std::max(first, last - int64_t(count) + 1); i <= last; ++i)
        parts.push_back({uint32_t(i % int64_t(count)), i == shown       ? 1.0f - part
                                                       : i == shown + 1 ? part
                                                                        : 0.0f});
    return parts;
}

/// The frame on whose lattice a step is shown: a whole frame on its own, and a moment between two on that
/// with the smaller voxels, unless those of the others are too large for it.
uint32_t latticeOf(const base::VolumeSequence& sequence, double before, double frame,
                   std::span<const Part> parts)
{
    if (sequence.hasOneLattice())
        return 0;
    const uint32_t count = sequence.count();
    const auto whole = int64_t(std::floor(frame + kWhole));
    const auto first = uint32_t(whole % int64_t(count)), next = (first + 1) % count;
    const bool isBetween = double(whole) <= before && frame - double(whole) > kWhole;
    uint32_t lattice = isBetween && sequence.lattice(next).side < sequence.lattice(first).side ? next : first;
    for (const Part& part : parts)
        if (!base::VolumeSequence::isNear(sequence.lattice(lattice), sequence.lattice(part.frame)))
            lattice = part.frame;
    return lattice;
}

/// Cells of frames on lattices of others, of the frames that were shown last.
class CellsOnLattices
{
public:
    explicit CellsOnLattices(const base::VolumeSequence& sequence) : sequence_(sequence) {}

    std::vector<base::VolumeCells> blended(std::span<const Part> parts, uint32_t lattice)
    {
        std::map<std::pair<uint32_t, uint32_t>, std::vector<base::VolumeCells>> kept;
        std::vector<const std::vector<base::VolumeCells>*> cells;
        for (const Part& part : parts) {
            const base::VolumeLattice own = sequence_.lattice(part.frame), shown = sequence_.lattice(lattice);
            if (own == shown) {
                cells.push_back(&sequence_.cells(part.frame));
                continue;
            }
            const auto name = std::pair(part.frame, lattice);
            const auto found = known_.find(name);
            cells.push_back(&(kept[name] = found != known_.end()
                                               ? std::move(found->second)
                                               : base::cellsOn(shown, sequence_.cells(part.frame), own)));
        }
        known_ = std::move(kept); // its elements stay where they are
        return blend(parts, cells);
    }

private:
    const base::VolumeSequence& sequence_;
    std::map<std::pair<uint32_t, uint32_t>, std::vector<base::VolumeCells>> known_; ///< by frame and lattice
};

class SequenceSolver final : public SequencePlayer
{
public:
    SequenceSolver(const SequenceDef& def, const base::SnapshotSchema& schema)
        : SequencePlayer(def.time()), def_(def), kinds_(schema), cells_(*def.sequence)
    {}

    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        if (kinds_.blobs == base::kNoKind)
            return;
        const uint32_t count = def_.sequence->count();
        const bool loops = def_.end == SequenceEnd::Loop;
        const SequenceTime::Way way = def_.time().wayTo(now(), base.step);
        const double last = loops ? INFINITY : double(count - 1);
        const double before = std::max(way.before, 0.0), frame = std::clamp(way.frame, before, last);
        const std::vector<Part> parts = partsOf(before, frame, count);
        const uint32_t lattice = latticeOf(*def_.sequence, before, frame, parts);
        const std::vector<base::VolumeCells> cells = cells_.blended(parts, lattice);
        BrickBalls{def_,
                   placeOf(def_, lattice),
                   cells,
                   std::max(def_.capacity(), uint32_t(cells.size())),
                   def_.asset,
                   def_.detail,
                   float(way.frame),
                   float(way.before),
                   1.0f / def_.framesPerSecond,
                   lattice,
                   loops,
                   def_.scale * float(def_.sequence->largestSide())}
            .publish(base, kinds_, snapshot);
    }

    uint32_t elementCount() const override
    {
        return uint32_t(def_.sequence->cells(uint32_t(frame())).size());
    }

private:
    const SequenceDef& def_;
    VolumeKinds kinds_;
    mutable CellsOnLattices cells_; ///< what publish() need not compute again
};

} // namespace

void SequenceDef::setSequence(std::shared_ptr<base::VolumeSequence> frames)
{
    sequence = std::move(frames);
    mostCells = 0;
    const uint32_t count = sequence->count();
    CellsOnLattices cells(*sequence);
    for (uint32_t i = 0; i < count; ++i) { // a step begins and ends between frames
        const std::vector<Part> parts = partsOf(i, i + 1.5, count);
        const uint32_t lattice = latticeOf(*sequence, i, i + 1.5, parts);
        mostCells = std::max(mostCells, uint32_t(cells.blended(parts, lattice).size()));
    }
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
            farthest = std::max(farthest, placeOf(*this, i).reachOf(own.brick));
    return farthest;
}

} // namespace fx::sim
