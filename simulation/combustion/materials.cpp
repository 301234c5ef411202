#include "simulation/combustion/materials.h"

#include <array>

namespace fx::sim {

// [MC00]: 8.7 m2/g +- 1.1 at 633 nm, mean of 29 fuels. [BB06]: albedo 0.2..0.3 of fresh aggregates.
const ParticleOptics kSootOptics{8700.0, 0.22};
// Transparent salt particles near the wavelength in size: order of magnitude, textbook (Mie theory).
const ParticleOptics kSaltOptics{3500.0, 0.95};

namespace {

constexpr double kMolarGasConstant = 8.314463; // [J/(mol K)]

constexpr Material makeTnt()
{
    Material m{};
    m.name = "tnt";
    m.nominalEnergy = kTntEquivalent; // the definition; [DC85] gives 7.0 GJ/m3 / 1630 kg/m3 = 4.29 MJ/kg
    m.heatAtStart = kTntEquivalent;
    // 14.5..15.0 MJ/kg of combustion in oxygen (textbook) less what the detonation has released
    m.heatOfCombustion = 10.4e6;
    // C7H5N3O6 + 5.25 O2 -> 7 CO2 + 2.5 H2O + 1.5 N2: 168 g of oxygen on 227.1 g, air 23.2 % oxygen by mass
    m.airNeeded = 168.0 / 227.1 / 0.232;
    m.ownOxygen = 0.0; // what its own oxygen burns is the detonation
    m.burningAtStart = 1.0;
    // C7H5N3O6 -> 1.5 N2 + 2.5 H2O + 3.5 CO + 3.5 C: 7.5 mol of gas of 227.1 g
    m.gasConstant = 7.5 / 0.2271 * kMolarGasConstant;
    m.startTemperature = 3450.0;   // behind the detonation 3000..3800 K: order of magnitude, textbook
    m.heatCapacity = 1300.0;       // of air and combustion gas, textbook
    m.startSpeed = 0.0;            // the pressure does it
    m.ignitionTemperature = 900.0; // of carbon monoxide in air, 880 K: textbook
    m.ignitionDelay = 1e-3;        // order of magnitude
    m.burnTime = 5e-3;             // order of magnitude; afterburning waits for air
    m.flameSoot = 0.185;           // the 3.5 mol of carbon above: 42.0 g on 227.1 g
    m.smokeSoot = 0.04;            // order of magnitude: most of the carbon burns
    m.fireballDiameter = 3.8;      // [HIG68] 3.86 m/kg^0.320 of rocket propellants, rounded to cube roots
    m.fireballDuration = 0.3;      // [HIG68] 0.299 s/kg^0.320
    m.jwl = {371.2e9, 3.231e9, 4.15, 0.95, 0.30, 7.0e9, 1630.0, 6930.0}; // [DC85]
    return m;
}

constexpr Material makePetrol()
{
    Material m{};
    m.name = "petrol";
    m.nominalEnergy = 43.5e6; // lower heat of combustion of gasoline, 43..44 MJ/kg: textbook [DRY11]
    m.heatOfCombustion = 43.5e6;
    m.airNeeded = 14.7; // stoichiometric air-fuel ratio of gasoline: textbook
    m.ownOxygen = 0.0;
    m.burningAtStart = 0.25;    // ignited from outside: ours
    m.gasConstant = 83.0;       // vapor of 100 g/mol
    m.startTemperature = 400.0; // middle of the boiling range, 310..480 K: textbook
    m.heatCapacity = 1300.0;
    m.startSpeed = 12.0;           // order of magnitude, of a burst vessel
    m.ignitionTemperature = 553.0; // autoignition of gasoline, 530..730 K: textbook
    m.ignitionDelay = 0.03;        // order of magnitude
    m.burnTime = 0.05;             // order of magnitude; the fireball waits for air
    m.flameSoot = 0.05;            // order of magnitude: a tenth of the fuel's carbon at the peak and less
    m.smokeSoot = 0.02; // smoke yield of large hydrocarbon fires, 0.01..0.15: order of magnitude [DRY11]
    m.fireballDiameter = 5.8;  // [ROB81] [CCPS10]
    m.fireballDuration = 0.45; // [ROB81] [CCPS10]
    m.largeMass = 30000.0;     // [CCPS10]
    m.largeDuration = 2.6;     // [CCPS10]
    return m;
}

constexpr Material makeBlackPowder()
{
    Material m{};
    m.name = "black-powder";
    m.nominalEnergy = 3.0e6; // [DAV43] 718.1 cal/g = 3.00 MJ/kg
    m.heatAtStart = 2.4e6;   // the part of it that has burnt when the casing bursts, four fifths: ours
    m.heatOfCombustion = 0.6e6;
    m.airNeeded = 0.0;
    m.ownOxygen = 1.0; // carries its own
    m.burningAtStart = 1.0;
    m.gasConstant =
        271.3e-3 / 22.414 * 1000.0 * kMolarGasConstant; // [DAV43] 271.3 cm3/g of gas at 0 C, 1 atm
    m.startTemperature = 2400.0;                        // 2300..2600 K: order of magnitude, textbook
    m.heatCapacity = 1200.0;
    m.startSpeed = 0.0;
    m.ignitionTemperature = 700.0; // 700..737 K: textbook
    m.ignitionDelay = 1e-3;        // order of magnitude
    m.burnTime = 5e-3;             // of grains of some tenths of a millimetre: order of magnitude
    m.flameSoot = 0.01;            // order of magnitude
    m.smokeSoot = 0.0;             // [DAV43] 0.08 % carbon in the residue
    m.smokeSalt = 0.56;            // [DAV43] the residue: potassium carbonate, sulfate and sulfide
    m.fireballDiameter = 2.6;      // gas and solids diluted with as much air: order of magnitude
    m.fireballDuration = 0.1;      // order of magnitude
    return m;
}

constexpr std::array<Material, 3> kMaterials{makeTnt(), makePetrol(), makeBlackPowder()};

} // namespace

std::span<const Material> materials()
{
    return kMaterials;
}

const Material* findMaterial(std::string_view name)
{
    for (const Material& material : kMaterials)
        if (material.name == name)
            return &material;
    return nullptr;
}

} // namespace fx::sim
