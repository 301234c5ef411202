#include "simulation/emitters/emitter_solver.h"

#include "simulation/solver/blob_writer.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;

constexpr uint64_t kSifted = 8; // [unit] of base::WorkBudget, of one that goes to its place in a heap

void writeConstants(const EmitterDef& def, BlobWriter& writer)
{
    writer.constant(base::blob_constant::Layer) = float(uint32_t(def.layer));
    writer.constant(base::blob_constant::DetailAmount) = def.detailAmount;
    writer.constant(base::blob_constant::DetailScale) = def.detailScale;
    writer.constant(base::blob_constant::Anisotropy) = def.anisotropy;
    writer.constant(base::blob_constant::Shutter) = def.shutter;
}

/// Writes the living of a tile behind those of the tiles before it.
class MediumTile
{
public:
    MediumTile(const EmitterDef& def, const ParticleStore& store, BlobWriter& writer)
        : def_(def), store_(store), writer_(writer)
    {}
    /// Row `row` of the store, which is `i` of `motion`, becomes element `to`.
    void write(uint32_t row, const MotionTile& motion, uint32_t i, uint32_t to) const
    {
        for (size_t a = 0; a < 3; ++a) {
            writer_.column(blob::PositionX + a)[to] = motion.position[a][i];
            writer_.column(blob::VelocityX + a)[to] = motion.velocity[a][i];
        }
        const float t = motion.life[i];
        const float excess = store_.value(stored::Excess, row) * def_.temperatureOverLife.at(t)[0];
        writer_.column(blob::Radius)[to] =
            store_.value(stored::Radius, row) * std::max(def_.sizeOverLife.at(t)[0], 1e-4f);
        writer_.column(blob::CrossSection)[to] =
            store_.value(stored::Amount, row) * std::max(def_.opacityOverLife.at(t)[0], 0.0f);
        writer_.column(blob::Temperature)[to] = std::max(kAirTemperature + excess, 0.0f);
        writer_.column(blob::Heat)[to] = def_.heat * std::max(excess, 0.0f);
        const std::array<float, 3> albedo = def_.albedoOverLife.at(t);
        const std::array<float, 3> emission = def_.emissionOverLife.at(t);
        for (size_t k = 0; k < 3; ++k) {
            const float tint = store_.value(stored::TintRed + k, row);
            writer_.column(blob::AlbedoR + k)[to] = std::min(albedo[k] * tint, 1.0f);
            writer_.column(blob::EmissionR + k)[to] = emission[k] * tint;
        }
        writer_.column(blob::Age)[to] = motion.age[i];
    }

private:
    const EmitterDef& def_;
    const ParticleStore& store_;
    BlobWriter& writer_;
};

/// Moves the index in the heap's place `place` of `count` down to where none below it is larger.
template <class Older>
void siftDown(std::span<uint32_t> heap, uint32_t place, uint32_t count, Older&& older)
{
    for (uint32_t child; (child = 2 * place + 1) < count; place = child) {
        if (child + 1 < count && older(heap[child], heap[child + 1]))
            ++child;
        if (!older(heap[place], heap[child]))
            return;
        std::swap(heap[place], heap[child]);
    }
}

// Parts of a medium's publication.
enum : uint32_t
{
    kCollect,
    kHeapify,
    kSort,
    kOpen,
    kWrite,
};

} // namespace

/// Living rows in order of birth index: the ring from its oldest on; only where births were dropped out of
/// order. @return whether all are in order
bool EmitterSolver::sortLiving(PublicationPlace& place, base::WorkBudget& work) const
{
    const auto older = [this](uint32_t a, uint32_t b) { return store_.index[a] < store_.index[b]; };
    const std::span<uint32_t> rows(rowsByBirth_);
    if (place.part == kCollect) {
        collectLiving(place, work);
        if (place.row < store_.rowsInUse())
            return false;
        place.part = place.isSorted ? kOpen : kHeapify;
        place.row = place.count / 2;
    }
    for (; place.part == kHeapify && place.row > 0; work.spend(kSifted)) {
        if (work.isSpent())
            return false;
        siftDown(rows, --place.row, place.count, older);
    }
    if (place.part == kHeapify) {
        place.part = kSort;
        place.row = place.count;
    }
    for (; place.part == kSort && place.row > 1; work.spend(kSifted)) {
        if (work.isSpent())
            return false;
        std::swap(rows[0], rows[--place.row]);
        siftDown(rows, 0, place.row, older);
    }
    if (place.part == kSort)
        place.part = kOpen;
    return true;
}

void EmitterSolver::collectLiving(PublicationPlace& place, base::WorkBudget& work) const
{
    const uint32_t first = store_.empty() ? 0 : store_.rowOf(store_.front());
    const uint32_t rows = work.affords(emitter_work::kListed, store_.rowsInUse() - place.row);
    uint32_t row = uint32_t((uint64_t(first) + place.row) % store_.capacity());
    for (uint32_t k = 0; k < rows; ++k, row = row + 1 == store_.capacity() ? 0 : row + 1) {
        if (!store_.isAlive(row, now_))
            continue;
        place.isSorted = place.isSorted && (place.count == 0 ||
                                            store_.index[rowsByBirth_[place.count - 1]] < store_.index[row]);
        rowsByBirth_[place.count++] = row;
    }
    place.row += rows;
    work.spend(uint64_t(emitter_work::kListed * double(rows)));
}

/// @return whether it is complete
bool EmitterSolver::publishMedium(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                  PublicationPlace& place, base::WorkBudget& work) const
{
    if (kinds_.blob == base::kNoKind)
        return true;
    if (place.part < kOpen && !sortLiving(place, work))
        return false;
    if (place.part == kOpen) {
        BlobWriter writer(snapshot, base, kinds_.blob, place.count, store_.capacity());
        writeConstants(def_, writer);
        if (hasMaterial())
            detail_->open(now_, kinds_.material, store_.capacity(), snapshot);
        place.row = 0;
        place.part = kWrite;
    }
    const size_t last = snapshot.addedCount() - 1;
    base::SnapshotGroup& blobs = snapshot.editGroup(hasMaterial() ? last - 1 : last);
    BlobWriter writer(blobs, snapshot.secondsBack());
    const uint32_t rows = work.affords(emitter_work::kMedium, place.count - place.row);
    writeMedium(base.solver, place.row, place.row + rows, writer);
    if (hasMaterial())
        writeMaterial(place.row, place.row + rows, blobs, snapshot.editGroup(last));
    place.row += rows;
    work.spend(uint64_t(emitter_work::kMedium * double(rows)));
    return place.row == place.count;
}

/// The coordinates of the elements [begin, end), which have been written to `blobs`.
void EmitterSolver::writeMaterial(uint32_t begin, uint32_t end, const base::SnapshotGroup& blobs,
                                  base::SnapshotGroup& material) const
{
    for (uint32_t i = begin; i < end; ++i) {
        detail_->write(rowsByBirth_[i], i, material);
        material.editIds()[i] = blobs.ids()[i];
    }
    material.editInfo().bounds = blobs.info().bounds;
}

/// The elements [begin, end) of the group.
void EmitterSolver::writeMedium(uint32_t solver, uint32_t begin, uint32_t end, BlobWriter& writer) const
{
    writer.fill(blob::FireShare, def_.fireShare, begin, end);
    const AppearanceJob job = appearanceJob();
    const MediumTile tile(def_, store_, writer);
    MotionTile motion;
    uint32_t first = 1; // row that the tile in hand begins with; rows begin at multiples, so none is in hand
    for (uint32_t i = begin; i < end; ++i) {
        const uint32_t row = rowsByBirth_[i];
        if (const uint32_t start = row / kTileRows * kTileRows; start != first) {
            readMotion(job, start, std::min(job.rows.count - start, kTileRows), motion);
            first = start;
        }
        tile.write(row, motion, row - first, i);
        writer.ids()[i] = blobId(solver, store_.index[row]);
    }
    writer.addBounds(begin, end);
}

} // namespace fx::sim
