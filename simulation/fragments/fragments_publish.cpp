#include "simulation/fragments/fragments_solver.h"

#include "simulation/combustion/fire_share.h"
#include "simulation/motion/ambient_air.h"
#include "simulation/motion/blob_optics.h"
#include "simulation/solver/blob_writer.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;
namespace constant = base::blob_constant;

constexpr float kSolid = 6.0f;              // [1] optical depth of what nothing shines through
constexpr uint64_t kTrail = 1ull << 39;     // marks ids of smoke
constexpr GlowRange kGlow{750.0f, 1050.0f}; // first visible glow, bright in daylight

} // namespace

bool FragmentsSolver::proceedPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                         PublicationPlace& place, base::WorkBudget& work) const
{
    if (kind_ == base::kNoKind)
        return true;
    if (place.group == 0) {
        publishFragments(base, snapshot);
        work.spend(uint64_t(fragment_work::kShown * double(fragments_.count)));
        openTrail(base, snapshot);
        place.group = 1;
    }
    BlobWriter writer(snapshot.editGroup(snapshot.addedCount() - 1), snapshot.secondsBack());
    const uint32_t rows = work.affords(fragment_work::kShown, writer.count() - place.row);
    writeTrail(base.solver, place.row, place.row + rows, writer);
    work.spend(uint64_t(fragment_work::kShown * double(rows)));
    place.row += rows;
    return place.row == writer.count();
}

void FragmentsSolver::publishFragments(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    namespace column = fragment_column;
    BlobWriter writer(snapshot, base, kind_, fragments_.count, uint32_t(fragments_.capacity()));
    writer.constant(constant::Layer) = float(uint32_t(base::MediaLayer::Dust));
    writer.constant(constant::DetailAmount) = 0.0f;
    writer.constant(constant::DetailScale) = 1.0f;
    writer.constant(constant::Anisotropy) = 0.0f;
    writer.constant(constant::Shutter) = def_.shutter;
    for (size_t k = 0; k < 3; ++k) {
        writer.copy(blob::PositionX + k, fragments_.at(column::X + k));
        writer.copy(blob::VelocityX + k, fragments_.at(column::VelocityX + k));
        writer.fill(blob::AlbedoR + k, 1.0f - def_.matter.emissivity);
        writer.fill(blob::EmissionR + k, 0.0f);
    }
    writer.fill(blob::Age, float(base::toSeconds(std::max(now_ - start_, base::Ticks(0)))));
    for (uint32_t i = 0; i < fragments_.count; ++i) {
        const float temperature = fragments_.at(column::Temperature)[i];
        const float radius = 0.5f * def_.visibleSize * fragments_.at(column::Size)[i];
        writer.column(blob::Radius)[i] = radius;
        writer.column(blob::CrossSection)[i] = crossSectionOf(kSolid, radius);
        writer.column(blob::Temperature)[i] = temperature;
        writer.column(blob::FireShare)[i] = fireShareOf(temperature, kGlow);
        writer.column(blob::Heat)[i] = def_.heat * std::max(temperature - kAirTemperature, 0.0f);
        writer.ids()[i] = blobId(base.solver, fragments_.number[i]);
    }
    writer.closeBounds();
}

/// Its group, without what is in the columns.
void FragmentsSolver::openTrail(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    const TrailDef& def = def_.trail;
    BlobWriter writer(snapshot, base, kind_, trail_.count, uint32_t(trail_.held()));
    writer.constant(constant::Layer) = float(uint32_t(base::MediaLayer::Smoke));
    writer.constant(constant::DetailAmount) = def.detailAmount;
    writer.constant(constant::DetailScale) = def.detailScale;
    writer.constant(constant::Anisotropy) = def.anisotropy;
    writer.constant(constant::Shutter) = 0.0f;
}

/// The elements [begin, end), by ascending id.
void FragmentsSolver::writeTrail(uint32_t solver, uint32_t begin, uint32_t end, BlobWriter& writer) const
{
    namespace column = trail_column;
    const TrailDef& def = def_.trail;
    for (size_t k = 0; k < 3; ++k)
        writer.fill(blob::EmissionR + k, 0.0f, begin, end);
    for (uint32_t i = begin; i < end; ++i) {
        const uint32_t row = trail_.order[i];
        const float age = float(base::toSeconds(now_ - trail_.born[row]));
        const float life = float(base::toSeconds(trail_.dies[row] - trail_.born[row]));
        const SmokeAppearance appearance = smokeAppearance(def, trail_.at(column::Radius)[row], age, life);
        for (size_t k = 0; k < 3; ++k) {
            writer.column(blob::PositionX + k)[i] = trail_.at(column::X + k)[row];
            writer.column(blob::VelocityX + k)[i] = trail_.at(column::VelocityX + k)[row];
        }
        const std::array<float, 3> albedo = def.albedoOverLife.at(age / life);
        writer.column(blob::Radius)[i] = appearance.radius;
        writer.column(blob::CrossSection)[i] = trail_.at(column::CrossSection)[row] * appearance.share;
        writer.column(blob::Temperature)[i] = appearance.temperature;
        writer.column(blob::FireShare)[i] = fireShareOf(appearance.temperature, kGlow);
        writer.column(blob::Heat)[i] = def_.heat * (appearance.temperature - kAirTemperature);
        writer.column(blob::Age)[i] = age;
        for (size_t k = 0; k < 3; ++k)
            writer.column(blob::AlbedoR + k)[i] = albedo[k];
        writer.ids()[i] = blobId(solver, kTrail | trail_.id[row]);
    }
    writer.addBounds(begin, end);
}

} // namespace fx::sim
