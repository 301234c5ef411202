#include "rendering/techniques/draw_techniques.h"

#include <algorithm>
#include <array>

namespace fx::render {

namespace {

constexpr const DrawTechnique* kTechniques[] = {
    &kBlockTechnique,         // before the balls, some of which it replaces
    &kBlockBallTechnique,     //
    &kBlockMaterialTechnique, //
    &kBlobTechnique,          //
    &kFieldDetailTechnique,   //
    &kVolumeTechnique,        //
    &kLightSliceTechnique,    //
    &kSpriteTechnique,        //
    &kRibbonTechnique,        //
    &kGpuParticleTechnique,   //
    &kParticleLightTechnique, //
    &kShimmerTechnique,       //
    &kDazzleTechnique,
};

/// Of passes that draw what techniques have gathered.
constexpr TimedPass kFramePasses[] = {{"media", "media"},        {"layer distance", "media"},
                                      {"layer spread", "media"}, {"layer upsample", "media"},
                                      {"layer over", "media"},   {"layer resolve", "media"}};

} // namespace

DrawTechniques drawTechniques()
{
    return kTechniques;
}

size_t effectLights(const base::FrameSnapshot& snapshot, std::span<EffectLight> out,
                    DrawTechniques techniques)
{
    std::array<const LightSource*, kMaxLightSources> sources{};
    size_t count = 0;
    for (const DrawTechnique* technique : techniques)
        if (technique->lights && count < sources.size())
            sources[count++] = technique->lights;
    return effectLights(snapshot, std::span(sources).first(count), out);
}

bool isDrawn(std::span<const base::KindDesc* const> kinds, DrawTechniques techniques)
{
    return std::ranges::any_of(techniques, [&](const DrawTechnique* technique) {
        return technique->kind && technique->create &&
               std::ranges::any_of(kinds, [&](const auto* kind) { return *kind == *technique->kind; });
    });
}

bool isUsed(const DrawTechnique& technique, const EffectContent& content)
{
    if (technique.isUsedBy)
        return technique.isUsedBy(content);
    return technique.kind &&
           std::ranges::any_of(content.kinds, [&](const auto* kind) { return *kind == *technique.kind; });
}

PassGroups passGroups(DrawTechniques techniques)
{
    PassGroups groups;
    groups.add(kFramePasses);
    for (const DrawTechnique* technique : techniques)
        groups.add(technique->passes);
    return groups;
}

} // namespace fx::render
