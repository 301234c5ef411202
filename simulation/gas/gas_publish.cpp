#include "simulation/gas/gas_solver.h"

#include "simulation/combustion/fire_share.h"
#include "simulation/combustion/parcel_optics.h"
#include "simulation/solver/blob_writer.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;

constexpr float kFireWidth = 0.2f; ///< [1] half width of the change from fire to smoke, of its temperature

void writeConstants(const GasDef& def, BlobWriter& writer)
{
    writer.constant(base::blob_constant::Layer) = float(uint32_t(base::MediaLayer::Smoke));
    writer.constant(base::blob_constant::DetailAmount) = def.detailAmount;
    writer.constant(base::blob_constant::DetailScale) = def.detailScale;
    writer.constant(base::blob_constant::Anisotropy) = def.anisotropy;
    writer.constant(base::blob_constant::Shutter) = 0.0f;
}

} // namespace

void GasSolver::publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    if (kind_ == base::kNoKind)
        return;
    BlobWriter writer(snapshot, base, kind_, elementCount(), particles_);
    writeConstants(def_, writer);
    if (elementCount() > 0) {
        writeMotion(writer);
        writeAppearance(writer);
    }
    for (size_t k = 0; k < 3; ++k)
        writer.fill(blob::EmissionR + k, 0.0f);
    writer.fill(blob::Age, float(base::toSeconds(now_ - released_)));
    for (uint32_t id = 0; id < elementCount(); ++id)
        writer.ids()[id] = blobId(base.solver, id);
    writer.closeBounds();
    if (detail_ && material_ != base::kNoKind)
        detail_->publish(material_, particles_, snapshot);
}

void GasSolver::writeMotion(BlobWriter& writer) const
{
    const GasView<const float> view = gas_.view();
    for (uint32_t i = 0; i < view.count; ++i) {
        const uint32_t id = view.id[i];
        writer.column(blob::PositionX)[id] = view.x[i];
        writer.column(blob::PositionY)[id] = view.y[i];
        writer.column(blob::PositionZ)[id] = view.z[i];
        writer.column(blob::VelocityX)[id] = view.vx[i];
        writer.column(blob::VelocityY)[id] = view.vy[i];
        writer.column(blob::VelocityZ)[id] = view.vz[i];
        writer.column(blob::Radius)[id] = 0.5f * def_.growth * view.support[i];
    }
}

void GasSolver::writeAppearance(BlobWriter& writer) const
{
    const GlowRange glow{(1.0f - kFireWidth) * def_.sootTemperature,
                         (1.0f + kFireWidth) * def_.sootTemperature};
    for (uint32_t id = 0; id < elementCount(); ++id) {
        const FireParcel& parcel = parcels_.fire[id];
        const ParcelOptics optics = opticsOf(*def_.material, parcel);
        const float temperature = float(parcel.temperature);
        const float seen = std::max(parcels_.presence[id] - kFaintest, 0.0f) / (1.0f - kFaintest);
        const std::array<float, 3> tint = def_.smokeTint.at(float(parcel.burnt));
        writer.column(blob::CrossSection)[id] = def_.opacity * seen * float(optics.extinction);
        writer.column(blob::Temperature)[id] = temperature;
        writer.column(blob::FireShare)[id] = fireShareOf(temperature, glow);
        writer.column(blob::Heat)[id] =
            def_.heat * seen * std::max(temperature - float(thermodynamics_.air.temperature), 0.0f);
        for (size_t k = 0; k < 3; ++k)
            writer.column(blob::AlbedoR + k)[id] = std::clamp(tint[k] * float(optics.albedo), 0.0f, 0.999f);
    }
}

} // namespace fx::sim
