#include "rendering/passes/programs.h"

#include "rendering/passes/composite_pass.h"
#include "rendering/passes/dazzle_pass.h"
#include "rendering/passes/heat_offset_pass.h"
#include "rendering/passes/heat_shimmer_pass.h"
#include "rendering/passes/impostor_pass.h"
#include "rendering/passes/layer_distance_pass.h"
#include "rendering/passes/layer_over_pass.h"
#include "rendering/passes/layer_resolve_pass.h"
#include "rendering/passes/layer_upsample_pass.h"
#include "rendering/passes/media_pass.h"
#include "rendering/passes/overdraw_pass.h"
#include "rendering/passes/overlay_pass.h"
#include "rendering/passes/present_pass.h"
#include "rendering/passes/scene_distance_pass.h"
#include "rendering/passes/tone_map_pass.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace fx::render {

namespace {

constexpr const ProgramDesc* kSinglePrograms[] = {
    &kSceneDistanceProgram, &kLayerResolveProgram,    &kCompositeBlendProgram, &kCompositeProgram,
    &kOverdrawProgram,      &kHeatOffsetProgram,      &kHeatShimmerProgram,    &kDazzleSumProgram,
    &kDazzleBudgetProgram,  &kDazzleDealProgram,      &kToneMapProgram,        &kToneMapDitherProgram,
    &kPresentProgram,       &kLayerDistanceProgram,   &kLayerUpsampleProgram,  &kLayerSpreadProgram,
    &kOverdrawSmallProgram, &kLayerOverProgram,       &kImpostorProgram,       &kImpostorKeepProgram,
    &kOverlayProgram,       &kHeatShimmerBackProgram,
};

} // namespace

std::span<const ProgramDesc* const> allPrograms()
{
    static const auto programs = [] {
        std::array<const ProgramDesc*, std::size(kSinglePrograms) + kMediaPrograms + kParticlePrograms> all{};
        std::copy(std::begin(kSinglePrograms), std::end(kSinglePrograms), all.begin());
        for (size_t i = 0; i < kMediaPrograms; ++i)
            all[std::size(kSinglePrograms) + i] = &mediaProgramAt(i);
        for (size_t i = 0; i < kParticlePrograms; ++i)
            all[std::size(kSinglePrograms) + kMediaPrograms + i] = &particleProgramAt(i);
        return all;
    }();
    return programs;
}

} // namespace fx::render
