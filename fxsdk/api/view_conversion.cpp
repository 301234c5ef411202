// The definitions of fx_view.h, checked and in the renderer's terms.
#include "fxsdk/api/check_projection.h"
#include "fxsdk/api/view_object.h"
#include "rendering/compositions/media_compositions.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace {

using fx::api::HostWorld;

static_assert(int(FX_DEPTH_REVERSED) == int(fx::render::DepthConvention::Reversed));
static_assert(int(FX_BILLBOARD_PLANAR) == int(fx::render::BillboardForm::Planar));
static_assert(int(FX_BILLBOARD_CONSTANT) == int(fx::render::BillboardForm::Constant));
static_assert(int(FX_BILLBOARD_KERNEL) == int(fx::render::BillboardForm::Kernel));
static_assert(int(FX_COMPOSITION_SORTED) == int(fx::render::Composition::Sorted));
static_assert(int(FX_COMPOSITION_SLABS) == int(fx::render::Composition::Slabs));
static_assert(int(FX_COMPOSITION_VOLUME) == int(fx::render::Composition::Volume));
static_assert(int(FX_COMPOSITION_AUTOMATIC) == int(fx::render::Composition::Automatic));

static_assert(int(FX_OUTPUT_INSTANCE_ID) == int(fx::render::view_output::InstanceId));
static_assert(int(FX_OUTPUT_MOTION) == int(fx::render::view_output::Motion));
static_assert(int(FX_OUTPUT_FIRST_DEPTH) == int(fx::render::view_output::FirstDepth));
static_assert(int(FX_OUTPUT_MEAN_DEPTH) == int(fx::render::view_output::MeanDepth));
static_assert(int(FX_OUTPUT_OPTICAL_DEPTH) == int(fx::render::view_output::OpticalDepth));

constexpr float kBrightest = 1e6f;  // [cd/m2] and [lx]
constexpr double kFarthest = 1e9;   // [m]
constexpr float kAllDepths = 1e9f;  // FxFrameDef::rangeFar of a frame without an end, in any unit
constexpr int32_t kWidest = 16'384; // [pixel]
constexpr float kUnitTolerance = 1e-3f;

void checkLight(fx::api::Checks& check, const FxViewSettings& given)
{
    check.range(given.exposureEv100, -20.0f, 40.0f, "settings.exposureEv100");
    check.range3(given.sunIlluminance, 0.0f, kBrightest, "settings.sunIlluminance");
    check.range3(given.skyLuminance, 0.0f, kBrightest, "settings.skyLuminance");
    check.range(given.groundAlbedo, 0.0f, 1.0f, "settings.groundAlbedo");
    const float length = glm::length(glm::make_vec3(given.sunDirection));
    check.that(std::abs(length - 1.0f) <= kUnitTolerance, "settings.sunDirection is not a unit vector");
}

void checkDazzle(fx::api::Checks& check, const FxViewSettings& given)
{
    check.flag(given.dazzle, "settings.dazzle");
    check.range(given.dazzleWhite, 1e-3f, 1e6f, "settings.dazzleWhite");
    check.range(given.dazzleA, -1e6f, 1e6f, "settings.dazzleA");
    check.range(given.dazzleB, -1e6f, 1e6f, "settings.dazzleB");
    check.range(given.dazzleC, 0.0f, 1e6f, "settings.dazzleC");
    check.range(given.dazzleRiseTime, 0.0f, 60.0f, "settings.dazzleRiseTime");
    check.range(given.dazzleFallTime, 0.0f, 60.0f, "settings.dazzleFallTime");
    const double least = given.dazzleB > 0 ? double(given.dazzleB) * std::exp(-2.0) : -double(given.dazzleB);
    check.that(double(given.dazzleA) >= least,
               "settings.dazzleA is too small for dazzleB: more light would give less glare");
}

void checkSwitches(fx::api::Checks& check, const FxViewSettings& given)
{
    check.range(given.shimmerStrength, 0.0f, 10.0f, "settings.shimmerStrength");
    check.range(given.shimmerMaxOffset, 0.0f, 100.0f, "settings.shimmerMaxOffset");
    check.range(given.billboardForm, 0u, uint32_t(FX_BILLBOARD_KERNEL), "settings.billboardForm");
    check.flag(given.saveState, "settings.saveState");
    check.flag(given.detail, "settings.detail");
    check.flag(given.toneMap, "settings.toneMap");
    check.flag(given.layerOutputs, "settings.layerOutputs");
    check.range(given.outputs, 0u, fx::render::view_output::kAll, "settings.outputs");
    check.flag(given.countOverdraw, "settings.countOverdraw");
    check.flag(given.activationOverlay, "settings.activationOverlay");
    check.that(given.layerScale == 1.0f || given.layerScale == 0.5f || given.layerScale == 0.25f,
               "settings.layerScale is not 1, 0.5 or 0.25");
    check.range(given.lodBias, 0.0f, 256.0f, "settings.lodBias");
    check.range(given.lodImpostorPixels, 0.0f, fx::render::LodSettings::kMaxImpostorPixels,
                "settings.lodImpostorPixels");
    check.range(given.blockParallax, 0.0f, fx::render::BlockSettings::kMaxParallax, "settings.blockParallax");
    check.range(given.blockError, 0.0f, 1.0f, "settings.blockError");
}

void checkSlices(fx::api::Checks& check, const FxViewSettings& given)
{
    check.flag(given.lightSlices, "settings.lightSlices");
    check.range(given.lightSlicePlanes, 2u, 128u, "settings.lightSlicePlanes");
    check.range(given.lightSliceTexels, 8u, 512u, "settings.lightSliceTexels");
    check.that(given.lightSliceTexels % 8 == 0,
               "settings.lightSliceTexels is not a multiple of 8: round it up");
    check.range(given.castingLights, 0u, 4u, "settings.castingLights");
    check.range(given.lightSamples, 1u, 4u, "settings.lightSamples");
    check.range(given.multipleScattering, 0u, 3u, "settings.multipleScattering");
    check.range(given.lightRefreshFrames, 1u, 16u, "settings.lightRefreshFrames");
}

void checkComposition(fx::api::Checks& check, const FxViewSettings& given)
{
    const bool isThere = given.composition == FX_COMPOSITION_AUTOMATIC ||
                         (given.composition <= 0xFFu &&
                          fx::render::findComposition(fx::render::Composition(given.composition)));
    check.that(isThere, "settings.composition is none of FX_COMPOSITION_...");
    check.that(given.slabs == 6 || given.slabs == 16, "settings.slabs is not 6 or 16");
    check.that(given.voxels >= 16 && given.voxels <= 256, "settings.voxels is not from 16 to 256");
}

void checkSunShadow(const HostWorld& world, fx::api::Checks& check, const FxFrameDef& given)
{
    check.range(given.sunShadowConvention, 0u, uint32_t(FX_DEPTH_REVERSED), "frame.sunShadowConvention");
    check.range(given.sunShadowEdge, 0.0f, world.fromMeters(100.0f), "frame.sunShadowEdge");
    const float* m = given.sunShadowMatrix;
    check.that(fx::base::allFinite(m, 16), "frame.sunShadowMatrix is not finite");
    check.that(
        m[3] == 0.0f && m[7] == 0.0f && m[11] == 0.0f && m[15] == 1.0f,
        "frame.sunShadowMatrix is not affine: its elements 3, 7, 11 and 15 must be 0, 0, 0 and 1, as of "
        "parallel light");
}

void checkTarget(fx::api::Checks& check, const FxFrameDef& given)
{
    check.flag(given.resetHistory, "frame.resetHistory");
    check.range(given.depthConvention, 0u, uint32_t(FX_DEPTH_REVERSED), "frame.depthConvention");
    check.flag(given.zeroToOne, "frame.zeroToOne");
    check.flag(given.upperLeftOrigin, "frame.upperLeftOrigin");
    check.range(given.target, 0u, uint32_t(FX_TARGET_FRAMEBUFFER), "frame.target");
    check.range(given.width, 1, kWidest, "frame.width");
    check.range(given.height, 1, kWidest, "frame.height");
    check.flag(given.holdQuality, "frame.holdQuality");
    check.range(given.deltaTime, 0.0, 1e6, "frame.deltaTime");
    check.that(given.target != FX_TARGET_TEXTURE || given.colorTexture != 0,
               "frame.colorTexture is 0; set it to a texture, or frame.target to FX_TARGET_FRAMEBUFFER");
    check.range(given.targetEncoding, 0u, uint32_t(FX_TARGET_DISPLAY_GAMMA), "frame.targetEncoding");
    check.flag(given.depthFromFramebuffer, "frame.depthFromFramebuffer");
    check.that(given.depthFromFramebuffer == 0 || given.depthTexture == 0,
               "frame.depthFromFramebuffer is 1 and frame.depthTexture is given: give one of them");
    check.range(given.viewportX, 0, kWidest, "frame.viewportX");
    check.range(given.viewportY, 0, kWidest, "frame.viewportY");
    check.flag(given.keepScissor, "frame.keepScissor");
    check.range(given.displayWhite, 1.0f, 1e6f, "frame.displayWhite");
}

void checkRange(const HostWorld& world, fx::api::Checks& check, const FxFrameDef& given)
{
    const float farthest = world.fromMeters(float(kFarthest));
    check.range(given.reserved, 0u, 0u, "frame.reserved");
    check.range(given.rangePart, uint32_t(FX_RANGE_ONLY), uint32_t(FX_RANGE_LAST), "frame.rangePart");
    check.range(given.rangeNear, 0.0f, farthest, "frame.rangeNear");
    check.range(given.rangeFar, 0.0f, std::max(farthest, kAllDepths), "frame.rangeFar");
    check.that(!(given.rangeFar <= given.rangeNear),
               "frame.rangeFar is not above frame.rangeNear: give the farther depth as rangeFar, or 1e9 for "
               "all effects behind rangeNear");
    const bool completes = given.rangePart == FX_RANGE_ONLY || given.rangePart == FX_RANGE_LAST;
    check.that(completes || given.target == FX_TARGET_TEXTURE || given.colorTexture == 0,
               "frame.rangePart is not the last and frame.colorTexture is only read, so that the next call "
               "would not see this one: set frame.target to FX_TARGET_TEXTURE, except in the last call");
}

fx::render::DepthRange toRange(const HostWorld& world, const FxFrameDef& given)
{
    fx::render::DepthRange range;
    if (given.rangeNear > 0.0f)
        range.from = world.toMeters(given.rangeNear);
    if (given.rangeFar != kAllDepths && given.rangeFar < world.fromMeters(float(kFarthest)))
        range.to = world.toMeters(given.rangeFar);
    range.isContinued = given.rangePart == FX_RANGE_NEXT || given.rangePart == FX_RANGE_LAST;
    range.isLast = given.rangePart == FX_RANGE_ONLY || given.rangePart == FX_RANGE_LAST;
    return range;
}

} // namespace

fx::base::Status fx::api::convertSettings(const HostWorld& world, const FxViewSettings& given,
                                          render::ViewSettings& outSettings)
{
    Checks check;
    checkLight(check, given);
    checkDazzle(check, given);
    checkSwitches(check, given);
    checkSlices(check, given);
    checkComposition(check, given);
    if (!check.status())
        return check.status();

    render::ViewSettings settings;
    settings.exposureEv100 = given.exposureEv100;
    settings.lighting.sunDirection = glm::normalize(world.direction(given.sunDirection));
    settings.lighting.sunIlluminance = glm::make_vec3(given.sunIlluminance);
    settings.lighting.skyLuminance = glm::make_vec3(given.skyLuminance);
    settings.lighting.groundAlbedo = given.groundAlbedo;
    settings.shimmer = {given.shimmerStrength, given.shimmerMaxOffset};
    settings.dazzle = {given.dazzle != 0, given.dazzleWhite,    given.dazzleA,       given.dazzleB,
                       given.dazzleC,     given.dazzleRiseTime, given.dazzleFallTime};
    settings.form = render::BillboardForm(given.billboardForm);
    settings.saveState = given.saveState != 0;
    settings.detail = given.detail != 0;
    settings.toneMap = given.toneMap != 0;
    settings.layerOutputs = given.layerOutputs != 0;
    settings.outputs = given.outputs;
    settings.countOverdraw = given.countOverdraw != 0;
    settings.overlay = given.activationOverlay != 0;
    settings.layerDivisor = int(1.0f / given.layerScale);
    settings.fragmentBudget = given.fragmentBudget;
    settings.lod.bias = given.lodBias;
    settings.lod.impostorPixels = given.lodImpostorPixels;
    settings.blocks.parallax = given.blockParallax;
    settings.blocks.error = given.blockError;
    render::SliceSettings& slices = settings.slices;
    slices.enabled = given.lightSlices != 0;
    slices.resolution = {int(given.lightSliceTexels), int(given.lightSlicePlanes)};
    slices.castingPoints = int(given.castingLights);
    slices.samples = int(given.lightSamples);
    slices.multiple = given.multipleScattering != 0;
    slices.network = given.multipleScattering == 2;
    slices.automatic = given.multipleScattering == 3;
    slices.refreshFrames = int(given.lightRefreshFrames);
    settings.composition = render::Composition(given.composition);
    settings.slabs = int(given.slabs);
    settings.voxels = int(given.voxels);
    outSettings = settings;
    return {};
}

fx::base::Status fx::api::convertBudget(const FxViewSettings& given, quality::BudgetOptions& outOptions)
{
    Checks check;
    check.range(given.budgetMilliseconds, 0.0f, 1e4f, "settings.budgetMilliseconds");
    check.range(given.budgetClock, uint32_t(FX_BUDGET_CLOCK_GPU), uint32_t(FX_BUDGET_CLOCK_CPU),
                "settings.budgetClock");
    if (!check.status())
        return check.status();
    outOptions.milliseconds = double(given.budgetMilliseconds);
    outOptions.clock =
        given.budgetClock == FX_BUDGET_CLOCK_CPU ? render::TimingClock::Host : render::TimingClock::Gpu;
    return {};
}

fx::base::Status fx::api::convertFrame(const HostWorld& world, const FxFrameDef& given,
                                       render::FrameRequest& outRequest)
{
    const double farthest = world.fromMeters(kFarthest);
    const glm::mat4 view = world.view(given.view), projection = world.projection(given.projection);
    Checks check;
    check.range3(given.origin, -farthest, farthest, "frame.origin");
    check.noFault(viewFault(glm::value_ptr(view)), "frame.view");
    check.noFault(projectionFault(glm::value_ptr(projection)), "frame.projection");
    checkTarget(check, given);
    checkSunShadow(world, check, given);
    checkRange(world, check, given);
    check.noFault(
        frameProjectionFault(glm::value_ptr(projection), given.depthConvention == FX_DEPTH_REVERSED),
        "frame.projection");
    if (!check.status())
        return check.status();

    render::CameraView& camera = outRequest.camera;
    camera.origin = world.position(given.origin);
    camera.view = view;
    camera.projection = projection;
    camera.depth = render::DepthConvention(given.depthConvention);
    camera.zeroToOne = given.zeroToOne != 0;
    camera.upperLeftOrigin = given.upperLeftOrigin != 0;
    render::HostTargets& targets = outRequest.targets;
    targets.useFramebuffer = given.target == FX_TARGET_FRAMEBUFFER;
    targets.color = given.colorTexture;
    targets.depth = given.depthTexture;
    targets.framebuffer = given.framebuffer;
    targets.width = given.width;
    targets.height = given.height;
    targets.x = given.viewportX;
    targets.y = given.viewportY;
    targets.encoding = render::TargetEncoding(given.targetEncoding);
    targets.depthFromFramebuffer = given.depthFromFramebuffer != 0;
    targets.keepScissor = given.keepScissor != 0;
    targets.displayWhite = given.displayWhite;
    outRequest.sunShadow = {given.sunShadowTexture, render::DepthConvention(given.sunShadowConvention),
                            world.ofWorld(given.sunShadowMatrix), world.toMeters(given.sunShadowEdge)};
    outRequest.deltaTime = given.deltaTime;
    outRequest.resetHistory = given.resetHistory != 0;
    outRequest.range = toRange(world, given);
    return {};
}
