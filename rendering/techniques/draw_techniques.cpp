#include "rendering/techniques/draw_techniques.h"

#include "rendering/techniques/blobs/blob_technique.h"
#include "rendering/techniques/dazzle/dazzle_technique.h"
#include "rendering/techniques/gpu_particles/gpu_particle_technique.h"
#include "rendering/techniques/ribbons/ribbon_technique.h"
#include "rendering/techniques/shimmer/shimmer_technique.h"
#include "rendering/techniques/sprites/sprite_technique.h"

namespace fx::render {

namespace {

constexpr const DrawTechnique* kTechniques[] = {
    &kBlobTechnique,        //
    &kSpriteTechnique,      //
    &kRibbonTechnique,      //
    &kGpuParticleTechnique, //
    &kShimmerTechnique,     //
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

PassGroups passGroups(DrawTechniques techniques)
{
    PassGroups groups;
    groups.add(kFramePasses);
    for (const DrawTechnique* technique : techniques)
        groups.add(technique->timedPasses);
    return groups;
}

} // namespace fx::render
