#include "fxsdk/presets/fragments/fragments_technique.h"

#include "embedded/fragments_schema.h"
#include "simulation/fragments/fragments_def.h"

#include <array>
#include <numbers>

namespace fx::preset {

namespace {

constexpr std::array<std::pair<std::string_view, sim::FragmentShape>, 3> kShapes{{
    {"sphere", sim::FragmentShape::Sphere},
    {"hemisphere", sim::FragmentShape::Hemisphere},
    {"cone", sim::FragmentShape::Cone},
}};

constexpr std::array<std::pair<std::string_view, sim::SizeLaw>, 2> kSizeLaws{{
    {"mott", sim::SizeLaw::Mott},
    {"power-law", sim::SizeLaw::PowerLaw},
}};

void readBurst(const PresetValue& element, sim::FragmentsDef& out)
{
    element.read("count", out.count);
    element.read("start", out.start);
    element.read("position", out.position);
    element.read("originRadius", out.originRadius);
    element.read("shape", std::span<const std::pair<std::string_view, sim::FragmentShape>>(kShapes),
                 out.shape);
    float degrees = 30.0f;
    element.read("angleDegrees", degrees);
    out.angle = degrees * (std::numbers::pi_v<float> / 180.0f);
    element.read("speed", out.speed);
    element.read("sizeLaw", std::span<const std::pair<std::string_view, sim::SizeLaw>>(kSizeLaws),
                 out.sizeLaw);
    element.read("size", out.size);
    element.read("meanSize", out.meanSize);
    element.read("exponent", out.exponent);
    element.read("temperature", out.temperature);
    element.read("lifetime", out.lifetime);
    element.read("visibleSize", out.visibleSize);
    element.read("shutter", out.shutter);
    element.read("heat", out.heat);
}

void readMatter(const PresetValue& matter, sim::FragmentMatter& out)
{
    matter.read("density", out.density);
    matter.read("specificHeat", out.specificHeat);
    matter.read("emissivity", out.emissivity);
    matter.read("dragCoefficient", out.dragCoefficient);
    matter.read("gravity", out.gravity);
    matter.read("bounce", out.bounce);
    matter.read("friction", out.friction);
}

void readTrail(const PresetValue& trail, sim::TrailDef& out)
{
    trail.read("spacing", out.spacing);
    trail.read("idle", out.idle);
    trail.read("maxBlobs", out.maxBlobs);
    trail.read("coldest", out.coldest);
    trail.read("lifetime", out.lifetime);
    trail.read("radius", out.radius);
    trail.read("opticalDepth", out.opticalDepth);
    trail.read("temperature", out.temperature);
    trail.read("mixing", out.mixing);
    trail.read("spreading", out.spreading);
    trail.read("inherited", out.inherited);
    trail.read("drag", out.drag);
    trail.read("buoyancy", out.buoyancy);
    trail.read("curlStrength", out.curlStrength);
    trail.read("curlScale", out.curlScale);
    trail.read("curlRate", out.curlRate);
    trail.read("albedoOverLife", out.albedoOverLife);
    trail.read("detailAmount", out.detailAmount);
    trail.read("detailScale", out.detailScale);
    trail.read("anisotropy", out.anisotropy);
}

constexpr double kPrewarmShare = 0.1; // [1] of the largest step's work in those of a prewarm

} // namespace

std::string_view fragmentsSchema()
{
    return fragments_schema::texts()[0].text;
}

void buildFragments(const PresetValue& element, sim::EffectDef& effect)
{
    auto fragments = std::make_unique<sim::FragmentsDef>();
    element.read("name", fragments->name);
    readBurst(element, *fragments);
    readMatter(element.child("matter"), fragments->matter);
    readTrail(element.child("trail"), fragments->trail);
    effect.solvers.push_back(std::move(fragments));
}

void estimateFragments(const PresetValue&, const sim::EffectDef&, std::span<SolverCost> ioCosts)
{
    for (SolverCost& cost : ioCosts) {
        cost.prewarmShare = kPrewarmShare;
        cost.workMember = cost.memoryMember = "trail/maxBlobs";
    }
}

} // namespace fx::preset
