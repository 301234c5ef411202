#include "rendering/techniques/blobs/blob_parts.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr std::string_view kForms[] = {"planar", "constant", "kernel"};

void lowerForm(float form, ViewSettings& settings)
{
    settings.form = std::min(settings.form, BillboardForm(uint8_t(form)));
}

void lowerDetail(float isOn, ViewSettings& settings)
{
    settings.detail = settings.detail && isOn != 0.0f;
}

void lowerParticles(float share, ViewSettings& settings)
{
    settings.particleShare = std::min(settings.particleShare, share);
}

/// A larger bias draws less.
void raiseLodBias(float bias, ViewSettings& settings)
{
    settings.lod.bias = std::max(settings.lod.bias, bias);
}

void lowerSamples(float samples, ViewSettings& settings)
{
    settings.slices.samples = std::min(settings.slices.samples, std::max(int(samples), 1));
}

void lowerMultiple(float isOn, ViewSettings& settings)
{
    settings.slices.multiple = settings.slices.multiple && isOn != 0.0f;
}

constexpr QualityKnob kKnobs[] = {
    {"billboards", "", QualityKnob::Type::Choice, kForms,
     R"({"title": "Billboards", "description": "Form of the billboards.", "type": "string",
         "enum": ["planar", "constant", "kernel"]})",
     lowerForm},
    {"detail",
     "detail",
     QualityKnob::Type::Switch,
     {},
     R"({"title": "Detail", "description": "Procedural detail on particles.", "type": "boolean"})",
     lowerDetail},
    {"particles",
     "particles",
     QualityKnob::Type::Number,
     {},
     R"({"title": "Particles", "description": "Share of the particles that is drawn, the others' extinction added to them.",
         "type": "number", "minimum": 0.015625, "maximum": 1})",
     lowerParticles},
    {"lodBias",
     "lod bias",
     QualityKnob::Type::Number,
     {},
     R"({"title": "Level of detail", "description": "Pixels of a far effect for which one particle of its media is drawn; 0: all are.",
         "type": "number", "minimum": 0, "maximum": 256})",
     raiseLodBias},
    {"lightSamples",
     "light samples",
     QualityKnob::Type::Number,
     {},
     R"({"title": "Light samples", "description": "Points of a ray through a ball at which light is looked up.",
         "type": "number", "minimum": 1, "maximum": 4})",
     lowerSamples},
    {"multiple",
     "multiple scattering",
     QualityKnob::Type::Switch,
     {},
     R"({"title": "Multiple scattering", "description": "Light that is scattered more than once.", "type": "boolean"})",
     lowerMultiple},
};

double weight(const ScreenShare& covered)
{
    return covered.media;
}

} // namespace

constexpr ScalabilitySettings kBlobScalability{"media", "all blobs of fire, smoke and dust", weight, kKnobs};

} // namespace fx::render
