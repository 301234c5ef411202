#include "fxsdk/assets/asset_loader.h"
#include "fxsdk/presets/emitters/emitter_parts_preset.h"

#include <array>
#include <cmath>
#include <numbers>

namespace fx::preset {

namespace {

template <class E, size_t N>
using Names = std::array<std::pair<std::string_view, E>, N>;

constexpr Names<sim::AppearanceKind, 4> kKinds{{{"medium", sim::AppearanceKind::Medium},
                                                {"sprite", sim::AppearanceKind::Sprite},
                                                {"mesh", sim::AppearanceKind::Mesh},
                                                {"none", sim::AppearanceKind::None}}};
constexpr Names<base::ParticleBlend, 3> kBlends{{{"alpha", base::ParticleBlend::Alpha},
                                                 {"additive", base::ParticleBlend::Additive},
                                                 {"opaque", base::ParticleBlend::Opaque}}};
constexpr Names<base::ParticleOrder, 4> kOrders{{{"none", base::ParticleOrder::None},
                                                 {"depth", base::ParticleOrder::Depth},
                                                 {"oldest", base::ParticleOrder::Oldest},
                                                 {"youngest", base::ParticleOrder::Youngest}}};
constexpr Names<base::SpriteAlignment, 4> kAlignments{{{"camera", base::SpriteAlignment::Camera},
                                                       {"velocity", base::SpriteAlignment::Velocity},
                                                       {"axis", base::SpriteAlignment::Axis},
                                                       {"plane", base::SpriteAlignment::Plane}}};
constexpr Names<sim::FrameClock, 3> kClocks{{{"none", sim::FrameClock::None},
                                             {"over-life", sim::FrameClock::OverLife},
                                             {"per-second", sim::FrameClock::PerSecond}}};

template <class E, size_t N>
void readName(const PresetValue& value, const char* member, const Names<E, N>& names, E& out)
{
    value.read(member, std::span<const std::pair<std::string_view, E>>(names), out);
}

void readDegrees(const PresetValue& value, const char* member, base::Range& out)
{
    constexpr float kRadians = std::numbers::pi_v<float> / 180.0f;
    base::Range degrees;
    value.read(member, degrees);
    out = {degrees.min * kRadians, degrees.max * kRadians};
}

/// The id that `load` makes of the member's name, or 0 with a finding.
template <class Load>
base::AssetId readAssetId(const PresetValue& value, const char* member, const Load& load)
{
    std::string name, warning;
    value.read(member, name);
    if (name.empty())
        return 0;
    const base::Result<base::AssetId> id = load(name, warning);
    if (!warning.empty())
        value.warning(member, warning);
    if (id)
        return *id;
    value.error(member, id.status().message());
    return 0;
}

void readAssets(const PresetValue& value, sim::EmitterAppearance& out)
{
    asset::AssetLoader& loader = *value.assets();
    const auto image = [&](asset::ImageUse use) {
        return [&, use](const std::string& name, std::string& warning) {
            return loader.image(name, use, int(out.tileColumns), int(out.tileRows), warning);
        };
    };
    out.texture = readAssetId(value, "texture", image(asset::ImageUse::Color));
    out.motion = readAssetId(value, "motion", image(asset::ImageUse::Numbers));
    out.mesh = readAssetId(value, "mesh", [&](const std::string& name, std::string& warning) {
        return loader.mesh(name, warning);
    });
    if (const base::MeshAsset* mesh = loader.table().mesh(out.mesh))
        out.meshReach = mesh->reach;
    if (out.kind == sim::AppearanceKind::Mesh && !value.has("mesh"))
        value.error("kind", "found kind \"mesh\" without a mesh; add \"mesh\": \"NAME.obj\"");
    if (out.motion != 0 && out.texture == 0 && !value.has("texture"))
        value.warning("motion", "motion vectors without a texture do nothing");
}

void readFrames(const PresetValue& value, sim::EmitterAppearance& out)
{
    value.read("tileColumns", out.tileColumns);
    value.read("tileRows", out.tileRows);
    value.read("frameBlend", out.frameBlend);
    value.read("motionScale", out.motionScale);
    readName(value, "frames", kClocks, out.frames);
    value.read("framesPerSecond", out.framesPerSecond);
    value.read("firstFrame", out.firstFrame);
}

void readColors(const PresetValue& value, sim::EmitterAppearance& out)
{
    value.read("colorOverLife", out.colorOverLife);
    value.read("opacity", out.opacity);
    value.read("brightness", out.brightness);
    value.read("fastest", out.fastest);
    value.read("colorOverSpeed", out.colorOverSpeed);
    value.read("sizeOverSpeed", out.sizeOverSpeed);
    value.read("opacityOverSpeed", out.opacityOverSpeed);
}

void readTrailTexture(const PresetValue& trail, sim::RibbonDef& out)
{
    bool isTiled = true;
    readName(trail, "textureMode", Names<bool, 2>{{{"tile", true}, {"stretch", false}}}, isTiled);
    if (!isTiled)
        out.arcPerTile = 0.0f;
    out.appearance.texture =
        readAssetId(trail, "texture", [&](const std::string& name, std::string& warning) {
            return trail.assets()->image(name, asset::ImageUse::Color, 1, 1, warning);
        });
}

} // namespace

void readEmitterAppearance(const PresetValue& appearance, sim::EmitterAppearance& out)
{
    readName(appearance, "kind", kKinds, out.kind);
    readName(appearance, "blend", kBlends, out.blend);
    readName(appearance, "order", kOrders, out.order);
    appearance.read("orderBias", out.orderBias);
    readName(appearance, "alignment", kAlignments, out.alignment);
    appearance.read("axis", out.axis);
    const float size = std::sqrt(out.axis.x * out.axis.x + out.axis.y * out.axis.y + out.axis.z * out.axis.z);
    if (size > 0.0f)
        out.axis /= size;
    else
        appearance.error("axis", "found an axis without length; any other direction is allowed");
    appearance.read("aspect", out.aspect);
    appearance.read("stretch", out.stretch);
    appearance.read("luminance", out.luminance);
    appearance.read("lit", out.lit);
    appearance.read("softness", out.softness);
    readFrames(appearance, out);
    readAssets(appearance, out);
    readColors(appearance, out);
    readDegrees(appearance, "angleDegrees", out.angle);
    readDegrees(appearance, "spinDegrees", out.spin);
}

void readEmitterTrail(const PresetValue& trail, sim::RibbonDef& out)
{
    trail.read("lifetime", out.lifetime);
    trail.read("width", out.width);
    trail.read("minDistance", out.minDistance);
    trail.read("maxPoints", out.maxPoints);
    trail.read("arcPerTile", out.arcPerTile);
    trail.read("edge", out.edge);
    trail.read("softEnds", out.softEnds);
    readTrailTexture(trail, out);
    trail.read("widthAlong", out.widthAlong);
    trail.read("colorAlong", out.colorAlong);
    trail.read("opacityAlong", out.opacityAlong);
    readName(trail, "blend", kBlends, out.appearance.blend);
    trail.read("orderBias", out.appearance.orderBias);
    trail.read("luminance", out.appearance.luminance);
    trail.read("lit", out.appearance.lit);
    trail.read("softness", out.appearance.softness);
}

void readEmitterLight(const PresetValue& element, sim::LightDef& out)
{
    out.given = element.has("light");
    const PresetValue light = element.child("light");
    light.read("intensity", out.intensity);
    light.read("count", out.maxLights);
    light.read("merged", out.merged);
}

} // namespace fx::preset
