#include "fxsdk/cli/scene/lit_stage.h"

#include "fxsdk/cli/scene/api_status.h"
#include "fxsdk/cli/scene/view_settings.h"

#include <cstddef>
#include <cstring>

namespace fx::cli {
namespace {

/// @param outTexture is set if media cast a shadow
base::Status readShadow(FxView* view, uint32_t kind, size_t index, render::MediaShadowBlock& out,
                        uint32_t& outTexture)
{
    FxMediaShadow shadow = {};
    shadow.structSize = sizeof shadow;
    const base::Status status = toStatus(fxView_GetMediaShadow(view, kind, uint32_t(index), &shadow));
    static_assert(sizeof shadow == 2 * sizeof(uint32_t) + sizeof out);
    std::memcpy(static_cast<void*>(&out),
                reinterpret_cast<const char*>(&shadow) + offsetof(FxMediaShadow, right), sizeof out);
    if (shadow.texture != 0)
        outTexture = shadow.texture;
    return status;
}

} // namespace

base::Status LitStage::read(FxView* view, std::span<const render::EffectLight> effects,
                            std::span<const render::SceneLight> lights, const render::Lighting& lighting)
{
    lighting_ = {};
    lighting_.lighting = lighting;
    for (size_t i = 0; i < effects.size(); ++i)
        lights_[i] = render::effectStageLight(effects[i]);
    for (size_t i = 0; i < lights.size(); ++i)
        lights_[effects.size() + i] = {toHostLight(lights[i])};
    lighting_.lights = std::span(lights_).first(effects.size() + lights.size());
    if (base::Status status = readShadow(view, FX_LIGHT_SUN, 0, lighting_.sunShadow, lighting_.shadowTexture);
        !status)
        return status;
    for (size_t i = 0; i < lighting_.lights.size(); ++i) {
        render::MediaShadowBlock shadow;
        const bool isEffect = i < effects.size();
        if (base::Status status =
                readShadow(view, isEffect ? FX_LIGHT_EFFECT : FX_LIGHT_HOST,
                           isEffect ? i : i - effects.size(), shadow, lighting_.shadowTexture);
            !status)
            return status;
        if (shadow.tiles[0].w > 0.5f)
            lights_[i].shadow = shadow;
    }
    return {};
}

} // namespace fx::cli
