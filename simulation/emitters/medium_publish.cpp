#include "simulation/emitters/emitter_solver.h"

#include "simulation/blob_writer.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;

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

} // namespace

/// Rows in order of birth index: the ring from its oldest on; only where births were dropped out of order.
uint32_t EmitterSolver::sortLiving() const
{
    const RowWindow rows = store_.window();
    uint32_t count = 0;
    bool ascending = true;
    const auto take = [&](uint32_t begin, uint32_t end) {
        for (uint32_t row = begin; row < end; ++row) {
            if (!store_.isAlive(row, now_))
                continue;
            ascending =
                ascending && (count == 0 || store_.index[rowsByBirth_[count - 1]] < store_.index[row]);
            rowsByBirth_[count++] = row;
        }
    };
    const uint32_t first = store_.empty() ? 0 : store_.rowOf(store_.front());
    take(first, rows.count);
    take(0, std::min(first, rows.gapBegin));
    if (!ascending) { // in place: indices differ, so that there is one order
        const auto older = [this](uint32_t a, uint32_t b) { return store_.index[a] < store_.index[b]; };
        std::make_heap(rowsByBirth_.begin(), rowsByBirth_.begin() + count, older);
        std::sort_heap(rowsByBirth_.begin(), rowsByBirth_.begin() + count, older);
    }
    return count;
}

void EmitterSolver::publishMedium(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    if (kinds_.blob == base::kNoKind)
        return;
    const uint32_t count = sortLiving();
    BlobWriter writer(snapshot, base, kinds_.blob, count, store_.capacity());
    writeConstants(def_, writer);
    writer.fill(blob::FireShare, def_.fireShare);
    const LookJob job = lookJob();
    const MediumTile tile(def_, store_, writer);
    MotionTile motion;
    uint32_t first = 1; // row that the tile in hand begins with; rows begin at multiples, so none is in hand
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t row = rowsByBirth_[i];
        if (const uint32_t begin = row / kTileRows * kTileRows; begin != first) {
            readMotion(job, begin, std::min(job.rows.count - begin, kTileRows), motion);
            first = begin;
        }
        tile.write(row, motion, row - first, i);
        writer.ids()[i] = blobId(base.solver, store_.index[row]);
    }
    writer.closeBounds();
}

} // namespace fx::sim
