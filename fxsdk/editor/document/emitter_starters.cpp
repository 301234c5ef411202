#include "fxsdk/editor/document/emitter_starters.h"

#include <algorithm>
#include <array>

namespace fx::editor {

namespace {

// Flame and steam are those of library:campfire and library:steam; smoke, dust and sparks are lighter,
// thinner and brighter than those of the library, such that they look right alone and in daylight.
constexpr auto kStarters = std::to_array<EmitterStarter>({
    {"flame", "a wood fire 0.8 m high", R"({
  "layer": "fire", "maxParticles": 320, "shape": "cone", "position": [0, 0.08, 0], "size": 0.24, "angleDegrees": 9,
  "emission": {"rate": 280}, "lifetime": {"min": 0.3, "max": 1}, "speed": {"min": 1, "max": 2.6},
  "radius": {"min": 0.06, "max": 0.15}, "opticalDepth": {"min": 0.05, "max": 0.1}, "temperature": {"min": 1400, "max": 1700},
  "forces": {"gravity": 0, "drag": 2, "buoyancy": 0.07, "curlStrength": 1.4, "curlScale": 0.7, "curlRate": 1.5},
  "sizeOverLife": {"keys": [[0, 1.3], [0.3, 1], [1, 0.12]]}, "opacityOverLife": {"keys": [[0, 0], [0.1, 1], [0.55, 0.8], [1, 0]]},
  "temperatureOverLife": {"keys": [[0, 1], [0.5, 0.92], [1, 0.64]]}, "albedoOverLife": [0.15, 0.15, 0.15],
  "fireShare": 1, "heat": 0.8, "shutter": 0.18, "detailAmount": 0.25, "detailScale": 0.5
})"},
    {"smoke", "gray smoke of a fire, which rises and spreads", R"({
  "layer": "smoke", "maxParticles": 320, "shape": "sphere", "position": [0, 0.3, 0], "size": 0.2,
  "emission": {"rate": 50}, "lifetime": {"min": 4, "max": 6}, "speed": {"min": 0.3, "max": 0.7},
  "radius": {"min": 0.15, "max": 0.32}, "opticalDepth": {"min": 4, "max": 8}, "temperature": {"min": 450, "max": 600},
  "forces": {"gravity": 0, "drag": 0.9, "buoyancy": 0.32, "curlStrength": 0.8, "curlScale": 1.5, "curlRate": 0.3, "curlOctaves": 2},
  "sizeOverLife": {"keys": [[0, 0.7], [0.2, 1.5], [1, 4.2]]}, "opacityOverLife": {"keys": [[0, 0], [0.04, 1], [0.6, 0.8], [1, 0]]},
  "temperatureOverLife": {"keys": [[0, 1], [0.3, 0.4], [1, 0.05]]}, "albedoOverLife": {"keys": [[0, [0.74, 0.73, 0.72]], [1, [0.85, 0.84, 0.82]]]},
  "detailAmount": 1, "detailScale": 0.9,
  "anisotropy": 0.5
})"},
    {"steam", "a white jet from a vent, which dissolves", R"({
  "layer": "smoke", "maxParticles": 620, "shape": "cone", "position": [0, 0.1, 0], "size": 0.13, "angleDegrees": 8,
  "emission": {"rate": 130}, "lifetime": {"min": 1.2, "max": 4.4}, "speed": {"min": 1.6, "max": 4.5},
  "radius": {"min": 0.07, "max": 0.36}, "opticalDepth": {"min": 5, "max": 14}, "temperature": {"min": 340, "max": 372},
  "forces": {"gravity": 0, "drag": 1.2, "buoyancy": 0.5, "curlStrength": 1.7, "curlScale": 0.9, "curlRate": 0.5, "curlOctaves": 2},
  "sizeOverLife": {"keys": [[0, 0.5], [0.1, 1.1], [0.3, 1.9], [1, 3.8]]},
  "opacityOverLife": {"keys": [[0, 0], [0.06, 0.8], [0.15, 1], [0.5, 0.7], [0.75, 0.2], [1, 0]]},
  "temperatureOverLife": {"keys": [[0, 1], [0.3, 0.3], [1, 0.05]]}, "albedoOverLife": [0.999, 0.999, 0.999],
  "heat": 0.3, "detailAmount": 0.8, "detailScale": 0.85, "anisotropy": 0.5
})"},
    {"sparks", "glowing metal that flies, falls and bounces", R"({
  "layer": "fire", "maxParticles": 480, "shape": "cone", "position": [0, 0.3, 0], "size": 0.02, "angleDegrees": 30,
  "emission": {"rate": 300}, "lifetime": {"min": 0.5, "max": 1.5}, "speed": {"min": 2, "max": 7},
  "radius": {"min": 0.004, "max": 0.009},
  "forces": {"gravity": 1, "drag": 1.1, "bounce": 0.4, "friction": 0.35},
  "opacityOverLife": {"keys": [[0, 1], [0.6, 0.8], [1, 0]]}, "light": {"intensity": 0.5, "merged": true},
  "appearance": {"kind": "sprite", "blend": "additive", "order": "none", "alignment": "velocity", "stretch": 0.0166667, "lit": 0,
    "luminance": 60000, "brightness": {"min": 0.2, "max": 1},
    "colorOverLife": {"keys": [[0, [1, 0.5, 0.14]], [0.25, [1, 0.36, 0.07]], [0.6, [0.8, 0.2, 0.03]], [1, [0.4, 0.06, 0.005]]]}}
})"},
    {"dust", "dust that is stirred up and drifts off", R"({
  "layer": "dust", "maxParticles": 240, "shape": "disc", "position": [0, 0.1, 0], "size": 0.6,
  "emission": {"rate": 40}, "lifetime": {"min": 2, "max": 5}, "speed": {"min": 0.3, "max": 1.2},
  "radius": {"min": 0.15, "max": 0.4}, "opticalDepth": {"min": 2, "max": 5},
  "forces": {"gravity": 0.02, "drag": 1.5, "curlStrength": 0.6, "curlScale": 1.8, "curlRate": 0.2, "curlOctaves": 2},
  "sizeOverLife": {"keys": [[0, 0.6], [0.15, 1.4], [1, 2.5]]}, "opacityOverLife": {"keys": [[0, 0], [0.1, 1], [0.4, 0.7], [1, 0]]},
  "albedoOverLife": [0.9, 0.82, 0.7], "detailAmount": 0.6, "detailScale": 0.9, "anisotropy": 0.68
})"},
});

bool hasEmitter(const Json& preset, const std::string& name)
{
    if (!preset.is_object() || !preset.contains("emitters") || !preset["emitters"].is_array())
        return false;
    const Json& emitters = preset["emitters"];
    return std::any_of(emitters.begin(), emitters.end(), [&](const Json& emitter) {
        return emitter.is_object() && emitter.value("name", Json()) == name;
    });
}

} // namespace

std::span<const EmitterStarter> emitterStarters()
{
    return kStarters;
}

Json starterEmitter(const EmitterStarter& starter, const Json& preset)
{
    std::string name = starter.name;
    for (int number = 2; hasEmitter(preset, name); ++number)
        name = starter.name + (" " + std::to_string(number));
    Json emitter = {{"name", name}};
    emitter.update(Json::parse(starter.members));
    return emitter;
}

} // namespace fx::editor
