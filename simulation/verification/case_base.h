/// @file case_base.h
/// Common base class of most cases. The class stores particles and sample times, and evaluates the flow
/// around the origin.
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
    /// Converts a particle to its distance from the origin and its speed away from the origin.
    ProfilePoint seen(const CaseParticle& particle) const override;

protected:
    /// Stores the settings of a case.
    /// @param gamma, time defaults of the case for values that the settings do not set
    CaseBase(const CaseSettings& settings, double gamma, double time);

    /// Sets def_ from the particles and settings. Constructors of derived classes call this function last.
    /// @param sampleCount number of equal intervals between samples
    void finish(uint32_t sampleCount);

    double gamma_;
    double time_;  ///< [s] end of the simulation
    bool ownTime_; ///< true: the limits of the case apply, because gamma and end time are defaults
    GasDynamicsDef def_;
    std::vector<GasParticle> particles_;

private:
    std::vector<double> sampleTimes_;
};

} // namespace fx::sim
