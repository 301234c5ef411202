#include "tests/marker/marker_preset.h"

#include "tests/marker/marker_solver.h"

#include <memory>

namespace fx::test {

std::string_view markerSchema()
{
    return R"({
  "title": "Marker",
  "description": "A square of one color that faces the view.",
  "type": "object",
  "additionalProperties": false,
  "properties": {
    "name": {"title": "Name", "description": "For people.", "type": "string", "maxLength": 128, "default": ""},
    "position": {"title": "Position", "description": "Of the center, at the start.", "x-kind": "vector",
        "x-unit": "m", "minimum": -10000, "maximum": 10000, "default": [0, 0, 0]},
    "side": {"title": "Side", "description": "Of the square.", "type": "number", "x-unit": "m",
        "minimum": 0.001, "maximum": 1000, "default": 1, "x-cost": "pixels drawn grow with its square"},
    "luminance": {"title": "Luminance", "description": "Of the square.", "x-kind": "color", "x-unit": "cd/m2",
        "minimum": 0, "maximum": 1000000, "default": [1, 1, 1]},
    "rise": {"title": "Rise", "description": "Speed along +Y.", "type": "number", "x-unit": "m/s",
        "minimum": -100, "maximum": 100, "default": 0}
  }
})";
}

void buildMarker(const preset::PresetValue& element, sim::EffectDef& effect)
{
    auto marker = std::make_unique<MarkerDef>();
    element.read("name", marker->name);
    element.read("position", marker->position);
    element.read("side", marker->side);
    element.read("luminance", marker->luminance);
    element.read("rise", marker->rise);
    effect.solvers.push_back(std::move(marker));
}

void lintMarkers(const preset::PresetValue& root, const sim::EffectDef&)
{
    for (size_t i = 0; i < root.size("markers"); ++i) {
        const preset::PresetValue element = root.element("markers", i);
        glm::vec3 luminance(1.0f);
        element.read("luminance", luminance);
        if (luminance == glm::vec3(0.0f))
            element.warning("luminance", "a marker of luminance 0 is black; give it a color above 0");
    }
}

} // namespace fx::test
