// Warnings about members of an emitter's shape and appearance that have no effect.
#include "fxsdk/presets/emitters/emitter_parts_preset.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

namespace fx::preset {

namespace {

using sim::AppearanceKind;

std::string nameOf(const PresetValue& value, const char* member, std::string absent)
{
    value.read(member, absent);
    return absent;
}

bool isOneOf(std::string_view name, std::initializer_list<std::string_view> names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// A member that only some shapes have.
struct ShapeMember
{
    const char* name;
    std::initializer_list<std::string_view> shapes;
};

void lintSpline(const PresetValue& element)
{
    glm::vec3 first(0.0f);
    element.readElement("points", 0, first);
    for (size_t i = 1; i < element.size("points"); ++i) {
        glm::vec3 other(0.0f);
        element.readElement("points", i, other);
        if (other != first)
            return;
    }
    element.warning("points", "all points of the spline are the same: births have no way to lie on; give it "
                              "different ones, or the shape \"point\"");
}

void warnOfAll(const PresetValue& value, std::initializer_list<const char*> members, const std::string& why)
{
    for (const char* member : members)
        if (value.has(member))
            value.warning(member, "has no effect " + why);
}

void lintSpeed(const PresetValue& appearance)
{
    float fastest = 0.0f;
    appearance.read("fastest", fastest);
    if (fastest <= 0.0f)
        warnOfAll(appearance, {"colorOverSpeed", "sizeOverSpeed", "opacityOverSpeed"},
                  "without \"fastest\", the speed at which the curve ends; add it");
}

void lintFrames(const PresetValue& appearance, const sim::EmitterAppearance& parsed)
{
    if (!appearance.has("texture"))
        warnOfAll(appearance, {"frames", "tileColumns", "tileRows", "firstFrame", "frameBlend"},
                  "without a texture that holds the frames; add \"texture\": \"NAME.png\"");
    else if (parsed.frames == sim::FrameClock::PerSecond && parsed.framesPerSecond <= 0.0f)
        appearance.warning("frames",
                           "found \"per-second\" with 0 frames per second, so that the first stays; "
                           "add \"framesPerSecond\"");
}

void lintMedium(const PresetValue& element)
{
    const PresetValue appearance = element.child("appearance");
    warnOfAll(appearance,
              {"texture", "motion", "mesh", "blend", "alignment", "stretch", "luminance", "colorOverLife",
               "opacity", "brightness", "angleDegrees", "spinDegrees", "frames", "fastest"},
              "on the kind \"medium\", which is made of balls of smoke or fire; add \"kind\": \"sprite\"");
}

void lintDrawn(const PresetValue& element, const sim::EmitterDef& emitter)
{
    const PresetValue appearance = element.child("appearance");
    const bool isMesh = emitter.appearance.kind == AppearanceKind::Mesh;
    lintSpeed(appearance);
    lintFrames(appearance, emitter.appearance);
    if (!isMesh)
        warnOfAll(appearance, {"mesh"}, "on the kind \"sprite\"; add \"kind\": \"mesh\"");
    if (emitter.appearance.stretch > 0.0f &&
        (isMesh || emitter.appearance.alignment != base::SpriteAlignment::Velocity))
        appearance.warning("stretch", "has no effect unless sprites stand along the velocity; add "
                                      "\"alignment\": \"velocity\"");
    warnOfAll(element,
              {"opticalDepth", "crossSection", "temperatureOverLife", "albedoOverLife", "emissionOverLife",
               "fireShare", "heat", "detailAmount", "detailScale", "detail", "anisotropy", "shutter"},
              "on the kind \"" + nameOf(appearance, "kind", "") +
                  "\", it is of the kind \"medium\"; take it out");
}

/// The light of what shines not: see LightDef::intensity.
void lintLight(const PresetValue& element, const sim::EmitterDef& emitter)
{
    const bool isMedium = emitter.appearance.kind == AppearanceKind::Medium;
    bool glows = !isMedium && (emitter.appearance.luminance > 0.0f || emitter.light.intensity > 0.0f);
    for (size_t i = 0; isMedium && i <= base::kCurveSamples; ++i)
        for (const float part : emitter.emissionOverLife.at(float(i) / float(base::kCurveSamples)))
            glows = glows || part > 0.0f;
    if (emitter.light.given && !glows)
        element.warning("light", isMedium
                                     ? "has no effect: in a medium it stands for \"emissionOverLife\", which "
                                       "is 0; hot media light their surroundings by themselves: take it out"
                                     : "sheds none: its intensity is 0, and so is the luminance that it "
                                       "would follow; add \"intensity\"");
}

} // namespace

void lintShape(const PresetValue& element)
{
    static const std::array<ShapeMember, 9> kMembers{{
        {"tube", {"torus"}},
        {"points", {"spline"}},
        {"closed", {"spline"}},
        {"file", {"mesh", "volume"}},
        {"angleDegrees", {"cone"}},
        {"height", {"cone"}},
        {"inner", {"sphere", "disc", "cone", "torus"}},
        {"surface", {"sphere", "box", "cone", "torus", "disc"}},
        {"size", {"sphere", "box", "cone", "line", "disc", "torus"}},
    }};
    const std::string shape = nameOf(element, "shape", "point");
    for (const ShapeMember& member : kMembers) {
        if (!element.has(member.name) || isOneOf(shape, member.shapes))
            continue;
        std::string shapes;
        for (const std::string_view name : member.shapes)
            shapes += (shapes.empty() ? "\"" : ", \"") + std::string(name) + "\"";
        element.warning(member.name, "has no effect on the shape \"" + shape + "\"; it is for " + shapes +
                                         ": take it out, or change \"shape\"");
    }
    if (shape == "spline")
        lintSpline(element);
}

void lintAppearance(const PresetValue& element, const sim::EmitterDef& emitter)
{
    if (emitter.appearance.kind == AppearanceKind::Medium)
        lintMedium(element);
    else if (emitter.appearance.kind != AppearanceKind::None)
        lintDrawn(element, emitter);
    lintLight(element, emitter);
}

} // namespace fx::preset
