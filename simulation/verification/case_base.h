/// @file case_base.h
/// Common base of most cases: particles, and a center or axis of evaluation.
#pragma once

#include "simulation/verification/gas_case.h"

#include <vector>

namespace fx::sim {

class CaseBase : public GasCase
{
public:
    const GasDynamicsDef& dynamics() const final { return def_; }
    const std::vector<GasParticle>& particles() const final { return particles_; }
    const std::vector<double>& sampleTimes() const final { return sampleTimes_; }
    /// Distance from the origin and speed away from it.
    ProfilePoint seen(const CaseParticle& particle) const override;

protected:
    /// @param gamma, time of the case, used where the settings leave them open
    CaseBase(const CaseSettings& settings, double gamma, double time);

    /// Fills def_ from the particles and settings; called last by constructors.
    /// @param sampleCount equal parts of the time
    void finish(uint32_t sampleCount);

    double gamma_;
    double time_;  ///< [s] end
    bool ownTime_; ///< the case's own gamma and end are used, so its limits hold
    GasDynamicsDef def_;
    std::vector<GasParticle> particles_;

private:
    std::vector<double> sampleTimes_;
};

} // namespace fx::sim
