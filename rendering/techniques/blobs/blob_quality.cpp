#include "rendering/techniques/blobs/blob_parts.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr std::string_view kForms[] = {"planar", "constant", "kernel"};
constexpr std::string_view kSums[] = {"sorted", "slabs", "volume"};

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

void lowerComposition(float composition, ViewSettings& settings)
{
    settings.composition = std::min(settings.composition, Composition(uint8_t(composition)));
}

void lowerSlabs(float slabs, ViewSettings& settings)
{
    settings.slabs = std::min(settings.slabs, slabs < 16.0f ? 6 : 16);
}

void lowerVoxels(float voxels, ViewSettings& settings)
{
    settings.voxels = std::min(settings.voxels, std::max(int(voxels), 16));
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
    {"composition", "", QualityKnob::Type::Choice, kSums,
     R"({"title": "Composition", "description": "How media that overlap are put together: volume is lowered to slabs, both to sorted.",
         "type": "string", "enum": ["sorted", "slabs", "volume"]})",
     lowerComposition},
    {"slabs",
     "slabs",
     QualityKnob::Type::Number,
     {},
     R"({"title": "Slabs", "description": "Slabs along each ray, of the composition slabs.", "type": "number", "minimum": 6, "maximum": 16})",
     lowerSlabs},
    {"voxels",
     "voxels",
     QualityKnob::Type::Number,
     {},
     R"({"title": "Voxels", "description": "Voxels along 16 radii of balls, of the composition volume.",
         "type": "number", "minimum": 16, "maximum": 256})",
     lowerVoxels},
};

double weight(const ScreenShare& covered)
{
    return covered.media;
}

} // namespace

constexpr ScalabilitySettings kBlobScalability{"media", "all blobs of fire, smoke and dust", weight, kKnobs};

} // namespace fx::render
