#include "rendering/passes/programs.h"

#include "rendering/passes/composite_pass.h"
#include "rendering/passes/display_decode_pass.h"
#include "rendering/passes/layer_distance_pass.h"
#include "rendering/passes/layer_sums_pass.h"
#include "rendering/passes/layer_upsample_pass.h"
#include "rendering/passes/overlay_pass.h"
#include "rendering/passes/present_changes_pass.h"
#include "rendering/passes/present_pass.h"
#include "rendering/passes/scene_distance_pass.h"
#include "rendering/passes/tone_map_pass.h"

namespace fx::render {

namespace {

constexpr const ProgramDesc* kPrograms[] = {
    &kSceneDistanceProgram, &kLayerResolveProgram,     &kCompositeBlendProgram, &kCompositeOffsetProgram,
    &kCompositeProgram,     &kCompositeDisplayProgram, &kToneMapProgram,        &kToneMapDitherProgram,
    &kPresentProgram,       &kPresentChangesProgram,   &kDisplayDecodeProgram,  &kLayerDistanceProgram,
    &kLayerUpsampleProgram, &kLayerSpreadProgram,      &kLayerOverProgram,      &kOverlayProgram,
};

} // namespace

std::span<const ProgramDesc* const> framePrograms()
{
    return kPrograms;
}

} // namespace fx::render
