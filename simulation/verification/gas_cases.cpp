#include "simulation/verification/gas_cases.h"

#include <array>

namespace fx::sim {
namespace {

constexpr std::array<GasCaseEntry, 6> kCases = {{
    {"sod", "shock tube: rarefaction, contact and shock between two resting gases", 65'536, makeSodCase},
    {"sedov", "point blast in cold gas", 262'144, makeSedovCase},
    {"noh", "cold gas falling on a point: a shock that stands off at 64 times the density", 262'144,
     makeNohCase},
    {"evrard", "collapse and bounce of a cold cloud, without gravity", 32'768, makeEvrardCase},
    {"kelvin-helmholtz", "waves that grow between two sliding streams", 110'592, makeKelvinHelmholtzCase},
    {"blast-wave", "a kilogram of TNT in air: peak overpressure at three distances", 110'592,
     makeBlastWaveCase},
}};

} // namespace

std::span<const GasCaseEntry> gasCases()
{
    return kCases;
}

const GasCaseEntry* findGasCase(std::string_view name)
{
    for (const GasCaseEntry& entry : kCases) {
        if (entry.name == name)
            return &entry;
    }
    return nullptr;
}

std::unique_ptr<GasCase> makeGasCase(const GasCaseEntry& entry, CaseSettings settings)
{
    if (settings.particles == 0)
        settings.particles = entry.particles;
    return entry.make(settings);
}

} // namespace fx::sim
