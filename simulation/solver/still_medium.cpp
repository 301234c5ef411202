#include "simulation/solver/still_medium.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;
namespace constant = base::blob_constant;

constexpr base::Ticks kAlways = INT64_MAX / 4; ///< later than any event

} // namespace

base::Ticks StillMediumSolver::restsUntil(base::Ticks tick) const
{
    return std::max(tick, kAlways);
}

void StillMediumSolver::writeShared(const StillMediumDef& def, BlobWriter& writer)
{
    writer.constant(constant::Layer) = float(uint32_t(def.layer));
    writer.constant(constant::DetailAmount) = 0.0f;
    writer.constant(constant::DetailScale) = 1.0f;
    writer.constant(constant::Anisotropy) = def.anisotropy;
    writer.constant(constant::Shutter) = 0.0f;
    for (const size_t empty : {blob::VelocityX, blob::VelocityY, blob::VelocityZ, blob::Heat, blob::Age})
        writer.fill(empty, 0.0f);
    writer.fill(blob::FireShare, def.fireShare);
}

} // namespace fx::sim
