#include "fxsdk/cli/scene/view_settings.h"

#include <cmath>

namespace fx::cli {

FxViewSettings toApi(const render::ViewSettings& settings)
{
    FxViewSettings api = fxDefaultViewSettings();
    api.exposureEv100 = settings.exposureEv100;
    for (int i = 0; i < 3; ++i) {
        api.sunDirection[i] = settings.lighting.sunDirection[i];
        api.sunIlluminance[i] = settings.lighting.sunIlluminance[i];
        api.skyLuminance[i] = settings.lighting.skyLuminance[i];
    }
    api.groundAlbedo = settings.lighting.groundAlbedo;
    api.shimmerStrength = settings.shimmer.strength;
    api.shimmerMaxOffset = settings.shimmer.maxOffset;
    api.dazzle = settings.dazzle.enabled ? 1 : 0;
    api.dazzleWhite = settings.dazzle.white;
    api.dazzleA = settings.dazzle.a;
    api.dazzleB = settings.dazzle.b;
    api.dazzleC = settings.dazzle.c;
    api.dazzleRiseTime = settings.dazzle.riseTime;
    api.dazzleFallTime = settings.dazzle.fallTime;
    api.billboardForm = uint32_t(settings.form);
    api.saveState = settings.saveState ? 1 : 0;
    api.detail = settings.detail ? 1 : 0;
    api.toneMap = settings.toneMap ? 1 : 0;
    api.layerOutputs = settings.layerOutputs ? 1 : 0;
    api.countOverdraw = settings.countOverdraw ? 1 : 0;
    api.activationOverlay = settings.overlay ? 1 : 0;
    api.layerScale = 1.0f / float(settings.layerDivisor);
    api.fragmentBudget = uint32_t(settings.fragmentBudget);
    api.lodBias = settings.lod.bias;
    api.lodImpostorPixels = settings.lod.impostorPixels;
    api.blockParallax = settings.blocks.parallax;
    api.blockError = settings.blocks.error;
    api.lightSlices = settings.slices.enabled ? 1 : 0;
    api.lightSlicePlanes = uint32_t(settings.slices.resolution.planes);
    api.lightSliceTexels = uint32_t(settings.slices.resolution.texels);
    api.castingLights = uint32_t(settings.slices.castingPoints);
    api.lightSamples = uint32_t(settings.slices.samples);
    api.multipleScattering = settings.slices.automatic   ? 3
                             : !settings.slices.multiple ? 0
                             : settings.slices.network   ? 2
                                                         : 1;
    api.lightRefreshFrames = uint32_t(settings.slices.refreshFrames);
    api.composition = uint32_t(settings.composition);
    api.slabs = uint32_t(settings.slabs);
    api.voxels = uint32_t(settings.voxels);
    api.outputs = settings.outputs;
    return api;
}

FxLight toApi(const render::SceneLight& light)
{
    FxLight api = fxDefaultLight();
    for (int i = 0; i < 3; ++i) {
        api.position[i] = light.position[i];
        api.intensity[i] = light.intensity[i];
        api.axis[i] = light.direction[i];
    }
    api.radius = light.radius;
    api.innerConeAngle = light.innerAngle;
    api.outerConeAngle = light.outerAngle;
    return api;
}

render::HostLight toHostLight(const render::SceneLight& light)
{
    render::HostLight host;
    host.position = light.position;
    host.intensity = light.intensity;
    host.radius = light.radius;
    host.axis = light.direction;
    if (light.isSpot()) {
        host.cosInner = std::cos(light.innerAngle);
        host.cosOuter = std::cos(light.outerAngle);
    }
    return host;
}

} // namespace fx::cli
