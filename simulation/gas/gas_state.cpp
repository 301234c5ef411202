#include "simulation/gas/gas_solver.h"

#include <algorithm>

namespace fx::sim {

void GasSolver::save(StateWriter& writer) const
{
    writer.value(now_);
    writer.flag(begun_);
    writer.flag(done_);
    if (!begun_)
        return;
    writer.value(hottest_);
    std::vector<std::byte> bytes;
    gas_.save(bytes);
    writer.block(bytes);
    for (uint32_t i = 0; i < particles_; ++i) {
        const FireParcel& p = parcels_.fire[i];
        for (const double value : {p.ownMass, p.unburnt, p.burning, p.burnt, p.mixing, p.temperature})
            writer.value(value);
    }
    writer.values(parcels_.vigor.first(particles_));
    writer.values(parcels_.presence.first(particles_));
    if (detail_)
        detail_->save(writer, particles_);
}

void GasSolver::restore(StateReader& reader)
{
    gas_.abandonAdvance();
    open_ = {};
    now_ = reader.value<base::Ticks>(0, INT64_MAX / 4, "a gas's clock is out of range");
    begun_ = reader.flag();
    done_ = reader.flag();
    if (!begun_) { // the solver may have released its gas before
        hottest_ = 0;
        if (const base::Status status = gas_.restore(unreleased_); !status.ok())
            reader.fail(status);
        return;
    }
    hottest_ = reader.value<float>(0.0f, 1e6f, "a gas's temperature is out of range");
    const base::Status restored = gas_.restore(reader.block());
    if (!restored.ok())
        reader.fail(restored);
    reader.require(gas_.count() == particles_ || done_, "a gas has another number of particles");
    for (uint32_t i = 0; i < particles_; ++i) {
        FireParcel& p = parcels_.fire[i];
        p.ownMass = reader.value<double>(1e-300, 1e300, "a parcel's mass is out of range");
        for (double* const share : {&p.unburnt, &p.burning, &p.burnt})
            *share = reader.value<double>(0.0, 1.0, "a parcel's share is out of range");
        p.mixing = reader.value<double>(1.0, kMaxMixing, "a parcel's mixing is out of range");
        p.temperature = reader.value<double>(1.0, 1e6, "a parcel's temperature is out of range");
    }
    reader.values(parcels_.vigor.first(particles_));
    reader.values(parcels_.presence.first(particles_));
    if (detail_)
        detail_->restore(reader, particles_);
}

} // namespace fx::sim
