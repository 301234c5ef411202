#include "fxsdk/presets/gas_preset.h"

#include "simulation/sph/gas_def.h"

namespace fx::preset {

namespace {

void readStart(const PresetValue& element, sim::GasDef& gas)
{
    element.read("particles", gas.particles);
    element.read("position", gas.position);
    element.read("start", gas.start);
    element.read("radius", gas.radius);
    element.read("temperature", gas.temperature);
    element.read("pressureRatio", gas.pressureRatio);
    element.read("soundSpeed", gas.soundSpeed);
    element.read("jitter", gas.jitter);
    element.read("initialSpeed", gas.initialSpeed);
    element.read("initialBias", gas.initialBias);
}

void readDynamics(const PresetValue& element, sim::GasDef& gas)
{
    element.read("cooling", gas.cooling);
    element.read("radiation", gas.radiation);
    element.read("drag", gas.drag);
    element.read("braking", gas.braking);
    element.read("buoyancy", gas.buoyancy);
    element.read("rolling", gas.rolling);
    element.read("curlStrength", gas.curlStrength);
    element.read("curlScale", gas.curlScale);
    element.read("viscosity", gas.viscosity);
}

void readOptics(const PresetValue& element, sim::GasDef& gas)
{
    element.read("sootYield", gas.sootYield);
    element.read("opticalDepth", gas.opticalDepth);
    element.read("albedoOverSoot", gas.albedoOverSoot);
    element.read("sootTemperature", gas.sootTemperature);
    element.read("growth", gas.growth);
    element.read("heat", gas.heat);
    element.read("dissipation", gas.dissipation);
    element.read("detailAmount", gas.detailAmount);
    element.read("detailScale", gas.detailScale);
    element.read("anisotropy", gas.anisotropy);
}

} // namespace

void buildGas(const PresetValue& element, sim::EffectDef& effect)
{
    auto gas = std::make_unique<sim::GasDef>();
    element.read("name", gas->name);
    readStart(element, *gas);
    readDynamics(element, *gas);
    readOptics(element, *gas);
    effect.solvers.push_back(std::move(gas));
}

} // namespace fx::preset
