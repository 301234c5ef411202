#include "simulation/emitters/emitter_solver.h"

#include "simulation/blob_writer.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;
namespace column = emitter_column;

void writeConstants(const EmitterDef& def, BlobWriter& writer)
{
    writer.constant(base::blob_constant::Layer) = float(uint32_t(def.layer));
    writer.constant(base::blob_constant::DetailAmount) = def.detailAmount;
    writer.constant(base::blob_constant::DetailScale) = def.detailScale;
    writer.constant(base::blob_constant::Anisotropy) = def.anisotropy;
    writer.constant(base::blob_constant::Shutter) = def.shutter;
}

void writeMotion(const EmitterStore& store, BlobWriter& writer)
{
    writer.copy(blob::PositionX, store.at(column::X));
    writer.copy(blob::PositionY, store.at(column::Y));
    writer.copy(blob::PositionZ, store.at(column::Z));
    writer.copy(blob::VelocityX, store.at(column::VelocityX));
    writer.copy(blob::VelocityY, store.at(column::VelocityY));
    writer.copy(blob::VelocityZ, store.at(column::VelocityZ));
}

/// Everything that changes over life by a curve; `life` is where each particle is in its own.
void writeLooks(const EmitterDef& def, const EmitterStore& store, const float* life, BlobWriter& writer)
{
    float* const radius = writer.column(blob::Radius);
    float* const crossSection = writer.column(blob::CrossSection);
    float* const temperature = writer.column(blob::Temperature);
    float* const heat = writer.column(blob::Heat);
    for (uint32_t i = 0; i < store.count; ++i) {
        const float t = life[i];
        const float excess = store.at(column::Excess)[i] * def.temperatureOverLife.at(t)[0];
        radius[i] = store.at(column::Radius)[i] * std::max(def.sizeOverLife.at(t)[0], 1e-4f);
        crossSection[i] = store.at(column::CrossSection)[i] * std::max(def.opacityOverLife.at(t)[0], 0.0f);
        temperature[i] = std::max(kAirTemperature + excess, 0.0f);
        heat[i] = def.heat * std::max(excess, 0.0f);
    }
    for (size_t k = 0; k < 3; ++k) {
        float* const albedo = writer.column(blob::AlbedoR + k);
        float* const emission = writer.column(blob::EmissionR + k);
        for (uint32_t i = 0; i < store.count; ++i) {
            albedo[i] = def.albedoOverLife.at(life[i])[k];
            emission[i] = def.emissionOverLife.at(life[i])[k];
        }
    }
}

} // namespace

void EmitterSolver::publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    if (kind_ == base::kNoKind)
        return;
    BlobWriter writer(snapshot, base, kind_, store_.count, uint32_t(store_.capacity()));
    writeConstants(def_, writer);
    writeMotion(store_, writer);
    writer.fill(blob::FireShare, def_.fireShare);

    float* const age = writer.column(blob::Age); // first as a fraction of life, then in seconds
    for (uint32_t i = 0; i < store_.count; ++i)
        age[i] = lifeFraction(store_, i, now_);
    writeLooks(def_, store_, age, writer);
    for (uint32_t i = 0; i < store_.count; ++i) {
        age[i] = float(base::toSeconds(now_ - store_.born[i]));
        writer.ids()[i] = blobId(base.solver, store_.index[i]);
    }
    writer.closeBounds();
}

} // namespace fx::sim
