#include "fxsdk/presets/gas/gas_technique.h"

#include "embedded/gas_schema.h"
#include "fxsdk/presets/field_detail_preset.h"
#include "simulation/combustion/charge_plan.h"
#include "simulation/gas/gas_def.h"

namespace fx::preset {

namespace {

void readCharge(const PresetValue& element, sim::GasDef& gas)
{
    std::string material(gas.material->name);
    element.read("material", material);
    if (const sim::Material* const found = sim::findMaterial(material))
        gas.material = found;
    element.read("energy", gas.energy);
    if (element.has("tntEquivalent")) {
        if (element.has("energy"))
            element.error("tntEquivalent", "found beside \"energy\"; allowed is one of the two");
        double kilograms = 0;
        element.read("tntEquivalent", kilograms);
        gas.energy = sim::energyOfTnt(kilograms);
    }
    element.read("pressureRatio", gas.pressureRatio);
}

void readStart(const PresetValue& element, sim::GasDef& gas)
{
    element.read("particles", gas.particles);
    element.read("position", gas.position);
    element.read("start", gas.start);
    element.read("soundSpeed", gas.soundSpeed);
    element.read("jitter", gas.jitter);
    element.read("lumpiness", gas.lumpiness);
    element.read("throwSpeed", gas.throwSpeed);
    element.read("initialBias", gas.initialBias);
}

void readDynamics(const PresetValue& element, sim::GasDef& gas)
{
    element.read("entrainment", gas.entrainment);
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
    element.read("opacity", gas.opacity);
    element.read("smokeTint", gas.smokeTint);
    element.read("sootTemperature", gas.sootTemperature);
    element.read("growth", gas.growth);
    element.read("heat", gas.heat);
    element.read("dissipation", gas.dissipation);
    element.read("detailAmount", gas.detailAmount);
    element.read("detailScale", gas.detailScale);
    element.read("anisotropy", gas.anisotropy);
    readFieldDetail(element, gas.detail);
}

constexpr double kPrewarmShare = 0.1; // [1] of the first step's work in those of a prewarm

} // namespace

std::string_view gasSchema()
{
    return gas_schema::texts()[0].text;
}

void buildGas(const PresetValue& element, sim::EffectDef& effect)
{
    auto gas = std::make_unique<sim::GasDef>();
    element.read("name", gas->name);
    readCharge(element, *gas);
    readStart(element, *gas);
    readDynamics(element, *gas);
    readOptics(element, *gas);
    effect.solvers.push_back(std::move(gas));
}

void estimateGas(const PresetValue& root, const sim::EffectDef&, std::span<SolverCost> ioCosts)
{
    for (SolverCost& cost : ioCosts) {
        float soundSpeed = 1.0f;
        root.element("gas", cost.place).read("soundSpeed", soundSpeed);
        cost.prewarmShare = kPrewarmShare;
        cost.workMember = cost.memoryMember = "particles";
        if (!(soundSpeed > 0.0f)) {
            cost.workMember = "soundSpeed";
            cost.workRemedy = "give a soundSpeed above 0, or lower particles";
        }
    }
}

} // namespace fx::preset
