#include "rendering/techniques/draw_techniques.h"

#include "rendering/lights/slices/view_lights.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr TimedPass kPasses[] = {
    {"light list", {}}, {"light slice casters", kLightSliceGroup}, {"light slices", kLightSliceGroup}};

constexpr int kTexelsOfAPlane = 4; ///< texels along a side for each plane

double weight(const ScreenShare& covered)
{
    return covered.media;
}

void lowerPlanes(float planes, ViewSettings& settings)
{
    SliceResolution& resolution = settings.slices.resolution;
    const int most = std::max(int(planes), 1);
    resolution.planes = std::min(resolution.planes, most);
    resolution.texels = std::min(resolution.texels, kTexelsOfAPlane * most);
}

constexpr QualityKnob kKnobs[] = {
    {"slicePlanes",
     "light slices",
     QualityKnob::Type::Number,
     {},
     R"({"title": "Light slices", "description": "Planes of optical depth across a light; four times as many texels.",
         "type": "number", "minimum": 3, "maximum": 128})",
     lowerPlanes},
};

constexpr ScalabilitySettings kScalability{"light slices", "shadows of media", weight, kKnobs};

} // namespace

constexpr DrawTechnique kLightSliceTechnique{
    .name = "light slices",
    .programs = lightPrograms,
    .passes = kPasses,
    .levels = &kScalability,
};

} // namespace fx::render
