/// @file module_cases.h
/// Emitters whose motion has no closed form, one for each module.
#pragma once

#include <string>

namespace fx::test {

/// Text of a preset with one emitter. The text `members` adds or replaces members of the emitter.
inline std::string
steppedText(const std::string& members, const char* compute,
            const char* births = R"("lifetime": {"min": 0.4, "max": 1.6}, "maxParticles": 1200,
                                                "emission": {"rate": 500})")
{
    return std::string(R"({"version": 1, "emitters": [{"compute": ")") + compute +
           R"(", "shape": "cone", "angleDegrees": 50, "size": [0.4, 0, 0], "position": [0.3, 1.5, 0.2],
           "speed": {"min": 2, "max": 5}, "radius": 0.03, "appearance": {"kind": "sprite", "stretch": 0.02,
           "alignment": "velocity"}, )" +
           births + ", " + members + "}]}";
}

/// Members of an emitter that require one or more modules.
struct ModuleCase
{
    const char* name;
    const char* members;
};

inline constexpr ModuleCase kModuleCases[] = {
    {"curl",
     R"("forces": {"drag": 2, "curlStrength": 1.5, "curlScale": 0.8, "curlRate": 0.7, "curlOctaves": 3})"},
    {"gust", R"("forces": {"drag": 3, "wind": [1, 0, 0.5], "gust": [1, 0.5, 2], "gustPeriod": 0.4})"},
    {"quadratic drag", R"("forces": {"drag": 0.3, "wind": [2, 0, 0], "quadraticDrag": 0.5})"},
    {"buoyancy",
     R"("temperature": {"min": 300, "max": 900}, "temperatureOverLife": {"keys": [[0, 1], [0.6, 0.2],
     [1, 0]]}, "forces": {"drag": 1.5, "buoyancy": 1})"},
    {"vortices", R"("forces": {"drag": 4, "vortices": [{"axis": [0.2, 1, 0], "radius": 0.7, "speed": 3,
     "lift": 1, "pull": 0.5}, {"radius": 2, "speed": 2, "hold": 0.8, "position": [1, 0, 0]}]})"},
    {"attractors", R"("forces": {"gravity": 0, "drag": 0.2, "attractors": [
     {"position": [1, 2, 0], "strength": 9, "falloff": "inverse-square"},
     {"position": [-1, 2, 0], "strength": 4, "falloff": "inverse", "reach": 3},
     {"position": [0, 0, 2], "strength": 2, "falloff": "constant"},
     {"position": [0, 4, 0], "strength": 3, "radius": 2, "falloff": "spring", "reach": 6}]})"},
    {"conform",
     R"("forces": {"gravity": 0, "conform": [{"shape": "sphere", "position": [0, 2, 0], "size": [1.5, 0, 0],
     "stiffness": 30, "damping": 4, "reach": 4}, {"shape": "box", "position": [0, 1, 1], "size": [1, 0.5, 0.7],
     "stiffness": 20, "damping": 2, "reach": 2, "distance": 0.1}]})"},
    {"bounce at the ground", R"("forces": {"drag": 0.2, "bounce": 0.6, "friction": 0.3})"},
    {"planes", R"("forces": {"drag": 0.1}, "collisions": [{"shape": "plane", "bounce": 0.7, "friction": 0.2},
     {"shape": "plane", "position": [1.2, 0, 0], "axis": [-1, 0.2, 0.1], "bounce": 0.4, "margin": 0.05},
     {"shape": "ground", "bounce": 0.2}])"},
    {"spheres and boxes",
     R"("collisions": [{"shape": "sphere", "position": [0.3, 2.6, 0.2], "size": [0.5, 0, 0],
     "bounce": 0.8}, {"shape": "sphere", "position": [0, 1, 0], "size": [3, 0, 0], "hollow": true, "bounce": 0.5},
     {"shape": "box", "position": [1.4, 1.5, 0], "size": [0.4, 0.3, 1], "axis": [0.3, 1, 0], "bounce": 0.9,
      "friction": 0.1}, {"shape": "box", "position": [0, 1.5, 0], "size": [2.4, 1.6, 2.2], "hollow": true}])"},
    {"those that slide",
     R"("collisions": [{"shape": "plane", "axis": [0.5, 1, 0], "position": [0, 1, 0], "bounce": 0,
     "friction": 0.02}, {"shape": "box", "position": [1, 0.2, 0], "size": [1, 0.4, 1], "bounce": 0}])"},
    {"those that stick", R"("collisions": [{"shape": "plane", "position": [0, 1, 0], "response": "stick"},
     {"shape": "sphere", "position": [0.5, 3, 0], "size": [0.6, 0, 0], "response": "stick"}])"},
    {"those that die", R"("forces": {"drag": 0.2, "attractors": [{"position": [1, 2, 0], "strength": 9,
     "killRadius": 0.5}]}, "collisions": [{"shape": "plane", "position": [0, 1, 0], "response": "kill"}])"},
    {"everything together",
     R"("forces": {"drag": 1, "wind": [0.5, 0, 0], "gust": [1, 0, 1], "quadraticDrag": 0.1,
     "curlStrength": 1, "vortices": [{"radius": 1, "speed": 2}], "bounce": 0.5}, "collisions": [
     {"shape": "sphere", "position": [0.3, 2.5, 0.2], "size": [0.4, 0, 0], "bounce": 0.5}])"},
};

} // namespace fx::test
