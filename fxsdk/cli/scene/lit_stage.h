/// @file lit_stage.h
/// What the effects of a view do to the opaque stage behind them: their fires light it, their media darken
/// it.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/fxsdk.h"
#include "rendering/frame/scene_light.h"
#include "rendering/stage/stage_renderer.h"

#include <array>
#include <span>

namespace fx::cli {

/// Largest number of effects whose light surfaces get.
constexpr size_t kMaxStageEffects = render::kMaxStageLights - FX_MOST_LIGHTS;

class LitStage
{
public:
    /// Reads the media shadows of the frame that fxView_PrepareLights() or fxView_Render() has drawn last.
    /// @param effects lights of effects, brightest first, at most kMaxStageEffects
    /// @param lights  lights of the scene in the order of fxView_SetLights(), at most FX_MOST_LIGHTS
    base::Status read(FxView* view, std::span<const render::EffectLight> effects,
                      std::span<const render::SceneLight> lights, const render::Lighting& lighting);

    /// What the stage is drawn with; valid until the next read().
    const render::StageLighting& lighting() const { return lighting_; }

private:
    std::array<render::StageLight, render::kMaxStageLights> lights_;
    render::StageLighting lighting_;
};

} // namespace fx::cli
