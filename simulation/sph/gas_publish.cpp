#include "simulation/sph/gas_solver.h"

#include "simulation/blob_writer.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/motion/blob_optics.h"
#include "simulation/sph/gas_optics.h"
#include "simulation/sph/gas_release.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;
namespace column = gas_column;

void writeConstants(const GasDef& def, BlobWriter& writer)
{
    writer.constant(base::blob_constant::Layer) = float(uint32_t(base::MediaLayer::Smoke));
    writer.constant(base::blob_constant::DetailAmount) = def.detailAmount;
    writer.constant(base::blob_constant::DetailScale) = def.detailScale;
    writer.constant(base::blob_constant::Anisotropy) = def.anisotropy;
    writer.constant(base::blob_constant::Shutter) = 0.0f;
}

/// From soot and temperature to what is seen: the cross section moves from that of the flame to that of the
/// smoke.
void writeLooks(const GasDef& def, const GasStore& gas, BlobWriter& writer)
{
    const float flame = crossSectionOf(def.opticalDepth, def.growth * releaseSmoothing(def));
    for (uint32_t i = 0; i < gas.count; ++i) {
        const float temperature = gas.at(column::Temperature)[i];
        const float soot = gas.at(column::Soot)[i];
        const float seen = std::max(gas.at(column::Presence)[i] - kFaintest, 0.0f) / (1.0f - kFaintest);
        const std::array<float, 3> albedo = def.albedoOverSoot.at(soot);
        writer.column(blob::Radius)[i] = def.growth * gas.at(column::Smoothing)[i];
        writer.column(blob::CrossSection)[i] = seen * (flame + soot * (def.sootYield - flame));
        writer.column(blob::Temperature)[i] = temperature;
        writer.column(blob::FireShare)[i] = fireShareOf(def, temperature);
        writer.column(blob::Heat)[i] = def.heat * seen * std::max(temperature - kAirTemperature, 0.0f);
        for (size_t k = 0; k < 3; ++k)
            writer.column(blob::AlbedoR + k)[i] = albedo[k];
    }
}

} // namespace

void GasSolver::publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    if (kind_ == base::kNoKind)
        return;
    BlobWriter writer(snapshot, base, kind_, gas_.count, uint32_t(gas_.columns[0].capacity()));
    writeConstants(def_, writer);
    writer.copy(blob::PositionX, gas_.at(column::X));
    writer.copy(blob::PositionY, gas_.at(column::Y));
    writer.copy(blob::PositionZ, gas_.at(column::Z));
    writer.copy(blob::VelocityX, gas_.at(column::VelocityX));
    writer.copy(blob::VelocityY, gas_.at(column::VelocityY));
    writer.copy(blob::VelocityZ, gas_.at(column::VelocityZ));
    writeLooks(def_, gas_, writer);
    for (size_t k = 0; k < 3; ++k)
        writer.fill(blob::EmissionR + k, 0.0f);
    writer.fill(blob::Age, float(base::toSeconds(now_ - released_)));
    for (uint32_t i = 0; i < gas_.count; ++i)
        writer.ids()[i] = blobId(base.solver, i);
    writer.closeBounds();
}

} // namespace fx::sim
