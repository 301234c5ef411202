/// @file fx_view.h
/// A view draws a scene into an image of the host's OpenGL 4.5 context. Include this to render effects.
///
/// Threads: everything here is [GL thread], the thread that created the context, unless a function says
/// otherwise. Calls may overlap with fxScene_Update() on the scene thread. Ownership: the caller owns every
/// FxView*; a view owns its textures and the history of its exposure and glare. The host owns its textures
/// and framebuffers.
///
/// GL state: with saveState = 1 fxView_Render() restores all GL state; with saveState = 0 it may change the
/// states that fxGetTouchedGlState() lists. Transform feedback and conditional rendering must not be active.
/// FxFrameDef states the host's clip control; the view does not change it. Formats of targets:
/// docs/howto/host-targets.md.
#ifndef FXSDK_FX_VIEW_H
#define FXSDK_FX_VIEW_H

#include "fxsdk/fx_base.h"
#include "fxsdk/fx_view_frame.h"
#include "fxsdk/fx_view_quality.h"
#include "fxsdk/fx_view_statistics.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Values of FxViewSettings::billboardForm.
enum
{
    FX_BILLBOARD_PLANAR = 0,   ///< flat card: the classical particle; cheapest; visible cuts at walls
    FX_BILLBOARD_CONSTANT = 1, ///< homogeneous sphere
    FX_BILLBOARD_KERNEL = 2    ///< sphere with the density profile of the gas; exact
};

/// Values of FxViewSettings::composition: how overlapping media are composited.
enum
{
    /// Particles are blended from the farthest to the nearest. Where particles overlap, the result is
    /// approximate. The voxels of preset members `volumes` are drawn as blurred balls, as with
    /// FX_COMPOSITION_SLABS.
    FX_COMPOSITION_SORTED = 0,

    /// Particles are summed in slabs along the ray of each pixel. The result does not depend on the order of
    /// particles.
    FX_COMPOSITION_SLABS = 1,

    /// Particles are summed in voxels, which are ray-marched. The result does not depend on the order of
    /// particles.
    FX_COMPOSITION_VOLUME = 2,

    /// The composition that the presets of the scene's instances request by their member `composition`, until
    /// the instances end. The composition applies to all media of the frame: FX_COMPOSITION_VOLUME if a
    /// preset requests it, otherwise FX_COMPOSITION_SLABS if a preset requests it, otherwise
    /// FX_COMPOSITION_SORTED.
    FX_COMPOSITION_AUTOMATIC = 3
};

/// Bits of FxViewSettings::outputs. Each bit adds a picture of reference data, see docs/howto/outputs.md.
enum
{
    FX_OUTPUT_INSTANCE_ID = 1,   ///< instance that contributes most to the pixel
    FX_OUTPUT_MOTION = 2,        ///< screen-space motion of visible particles since the last frame
    FX_OUTPUT_FIRST_DEPTH = 4,   ///< distance at which the optical depth reaches 0.01
    FX_OUTPUT_MEAN_DEPTH = 8,    ///< mean distance of visible particles
    FX_OUTPUT_OPTICAL_DEPTH = 16 ///< optical depth of all media
};

/// Values of FxViewSettings::budgetClock.
enum
{
    FX_BUDGET_CLOCK_GPU = 0, ///< GPU time by timestamps, available some frames later; causes no wait
    /// Time on the calling thread from the call to the end of all GL work. This clock waits for the GPU
    /// (glFinish) up to six times a frame. The clock is meant for tools, software renderers and drivers
    /// without timestamps.
    FX_BUDGET_CLOCK_CPU = 1
};

/// Settings of a view, for all frames. Fill with fxDefaultViewSettings(), then change members.
typedef struct FxViewSettings
{
    /// Set by fxDefaultViewSettings(); do not touch.
    uint32_t structSize;

    /// [EV100] -20..40; luminance is multiplied by 1 / (1.2 * 2^EV100); default 13.
    float exposureEv100;

    /// Direction towards the sun, a unit vector (length within 1e-3 of 1); default 0.3, 0.8, 0.52 normalized.
    float sunDirection[3];

    /// [lx] 0..1e6, illuminance of a plane that faces the sun; default 0.
    float sunIlluminance[3];

    /// [cd/m2] 0..1e6, luminance of the sky, equal in all directions; default 0.
    float skyLuminance[3];

    /// [1] 0..1, fraction of light that the ground reflects; default 0.2.
    float groundAlbedo;

    /// [1] 0..10, heat shimmer; 0 leaves the picture untouched, bit for bit; default 1.
    float shimmerStrength;

    /// [pixel] 0..100, largest offset by heat shimmer in a picture that is 720 pixels high; default 12.
    float shimmerMaxOffset;

    /// 1 (default): glare; 0: none.
    uint32_t dazzle;

    /// [1] 1e-3..1e6, exposed value at which the sensor saturates; default 8.
    float dazzleWhite;

    /// [1] sensor law f(over) = over (A + B exp(-C over)), over: mean overflow per pixel in units of
    /// dazzleWhite; A >= B exp(-2) and A >= -B; A = 1 spreads all overflow; default 0.01, a clean lens.
    float dazzleA;

    /// [1] see dazzleA; default 0.
    float dazzleB;

    /// [1] >= 0, see dazzleA; default 1.
    float dazzleC;

    /// [s] 0..60, time constant of growing glare; default 0.05.
    float dazzleRiseTime;

    /// [s] 0..60, time constant of fading glare; default 0.4.
    float dazzleFallTime;

    /// FX_BILLBOARD_...; default FX_BILLBOARD_KERNEL.
    uint32_t billboardForm;

    /// 1 (default): fxView_Render() restores every GL state that it changes; 0: the host restores GL state.
    uint32_t saveState;

    /// 1 (default): procedural detail on particles; 0: bare kernels.
    uint32_t detail;

    /// 1: tone-map the whole picture and write it as a display shows it, encoded by the curve of sRGB, into a
    /// target that holds plain numbers; 0 (default): scene-linear. Must be 0 with a display encoding of
    /// FxFrameDef::targetEncoding.
    uint32_t toneMap;

    /// 1: provide fire, smoke, dust, depth and optical depth as textures; default 0.
    uint32_t layerOutputs;

    /// 1: count fragments and read statistics back, which costs a pass and a wait for the GPU; default 0.
    uint32_t countOverdraw;

    /// [1] 1 (default), 0.5 or 0.25: width and height of the layers that particles are drawn to, relative to
    /// the picture; edges of opaque surfaces stay sharp.
    float layerScale;

    /// Estimated fragments above which a frame is drawn at a smaller layerScale, until 30 consecutive frames
    /// need less; 0 (default): no limit.
    uint32_t fragmentBudget;

    /// [ms] 0..1e4, time budget of a frame of this view; 0 (default): none. With a budget, quality may be
    /// lower than these settings, never higher. The simulation does not depend on it.
    float budgetMilliseconds;

    /// FX_BUDGET_CLOCK_...; default FX_BUDGET_CLOCK_GPU.
    uint32_t budgetClock;

    /// [1] 0..256, level of detail: an effect draws one particle or ribbon segment for each lodBias pixels of
    /// its projected disk, and at least twelve in all. The drawn elements are adjusted continuously, which
    /// preserves light and coverage. The difference is hardly visible at 1 and visible at 16. 0 (default):
    /// all particles are drawn. Particles that are computed on the GPU are always drawn. The simulation does
    /// not depend on it.
    float lodBias;

    /// [pixel] 0..13, an effect whose bounding sphere has a smaller radius on the picture is drawn as an
    /// impostor. The impostor is re-rendered ten times a second while the effect changes, and when the view
    /// direction changes; successive pictures are cross-faded. Impostors are not used with layerOutputs,
    /// outputs or orthographic projections. 0 (default): no impostors.
    float lodImpostorPixels;

    /// 1: draws the bounding boxes of visibility culling, as of the last update, over the picture. The color
    /// states the activity of an instance: green active, yellow catching up, blue resting, gray not started,
    /// red hidden (out of view, too far or too small), orange occluded, magenta beyond the budget. A box of
    /// unknown extent is 1 m wide. The overlay is meant for debugging: with it, each update visits all
    /// instances. Default 0.
    uint32_t activationOverlay;

    /// 1 (default): media cast shadows on themselves, on each other and on the host's surfaces
    /// (fx_view_lights.h); 0: media cast no shadows. The shadows are computed by light slices. A light slice
    /// stores the optical depth on a plane across the direction of a light.
    uint32_t lightSlices;

    /// 2..128, number of planes of the sun's light slices; point lights have half as many; default 32.
    uint32_t lightSlicePlanes;

    /// [texel] 8..512, a multiple of 8, side length of a plane of the sun; planes of point lights have half
    /// this side length; default 128.
    uint32_t lightSliceTexels;

    /// 0..4, number of point lights that cast shadows through media: the lights that illuminate the media
    /// most; default 2.
    uint32_t castingLights;

    /// 1..4, number of samples of the sun's light along a view ray through one particle; default 2.
    uint32_t lightSamples;

    /// Scattering in media. 0: single scattering; 1 (default): multiple scattering by a closed form; 2: like
    /// 1, but by an illumination network in media that FX_COMPOSITION_VOLUME or FX_COMPOSITION_SLABS draws;
    /// 3: the greatest value that the presets of the scene's instances request by their member "scattering",
    /// or 1 if no preset requests a value.
    uint32_t multipleScattering;

    /// FX_COMPOSITION_...; default FX_COMPOSITION_SORTED.
    uint32_t composition;

    /// 6 or 16, number of slabs along the ray of each pixel with FX_COMPOSITION_SLABS; default 16.
    uint32_t slabs;

    /// 16..256, number of voxels along 16 particle radii with FX_COMPOSITION_VOLUME; default 96. Effects that
    /// are small on the picture get fewer voxels.
    uint32_t voxels;

    /// 1..16, number of frames between updates of light slices for moving media; default 1. Shadows of media
    /// lag by at most this number minus one frames. Between updates, the passes that fill the planes are not
    /// executed. When a light moves, its slices are updated at once. When media come to rest, the slices are
    /// updated in the next frame.
    uint32_t lightRefreshFrames;

    /// Bits FX_OUTPUT_...: select the pictures that fxView_GetOutputTextures() returns. These pictures have
    /// the size of the frame and are the same for all compositions. With outputs, effects are drawn one by
    /// one and never as impostors. Default 0: no passes, programs and textures for outputs exist. The first
    /// frame with outputs compiles their programs, unless fxContext_WarmUp() was called while a view had
    /// these settings.
    uint32_t outputs;

    /// [pixel] 0..16: largest error of the place of medium within a block that is drawn as an impostor, by
    /// its direction and its motion; default 0.5. 0: all particles of blocks are drawn. Impostors are drawn
    /// with FX_COMPOSITION_SLABS and without outputs only.
    float blockParallax;

    /// [1] 0..1, in units of white: largest root mean square error, over the pixels that a block covers, that
    /// an impostor of the block is predicted to have; default 4/255. Blocks that no impostor shows as exactly
    /// are drawn as their particles or smaller blocks. The prediction is that of the block alone, unlit media
    /// count as white. 0: not limited.
    float blockError;
} FxViewSettings;

/// Default settings: daylight exposure, no lights, all effects enabled.
static inline FxViewSettings fxDefaultViewSettings(void)
{
    FxViewSettings settings = FX_ZEROED;
    settings.structSize = sizeof(FxViewSettings);
    settings.exposureEv100 = 13.0f;
    settings.sunDirection[0] = 0.3f;
    settings.sunDirection[1] = 0.8f;
    settings.sunDirection[2] = 0.51961524f;
    settings.groundAlbedo = 0.2f;
    settings.shimmerStrength = 1.0f;
    settings.shimmerMaxOffset = 12.0f;
    settings.dazzle = 1;
    settings.dazzleWhite = 8.0f;
    settings.dazzleA = 0.01f;
    settings.dazzleC = 1.0f;
    settings.dazzleRiseTime = 0.05f;
    settings.dazzleFallTime = 0.4f;
    settings.billboardForm = FX_BILLBOARD_KERNEL;
    settings.saveState = 1;
    settings.detail = 1;
    settings.layerScale = 1.0f;
    settings.lightSlices = 1;
    settings.lightSlicePlanes = 32;
    settings.lightSliceTexels = 128;
    settings.castingLights = 2;
    settings.lightSamples = 2;
    settings.multipleScattering = 1;
    settings.composition = FX_COMPOSITION_SORTED;
    settings.slabs = 16;
    settings.voxels = 96;
    settings.lightRefreshFrames = 1;
    settings.blockParallax = 0.5f;
    settings.blockError = 4.0f / 255.0f;
    return settings;
}

/// Layer textures of the last frame: GL names, 0 when settings.layerOutputs was 0. Fill structSize with
/// sizeof before the call. The textures belong to the view and are valid until its next fxView_Render().
typedef struct FxLayerTextures
{
    /// Set by the caller.
    uint32_t structSize;

    /// RGBA32F. RGB: light of fire that reaches the eye [cd/m2 times exposure], premultiplied; A: the part of
    /// the opacity that fire contributes.
    uint32_t fire;

    /// RGBA32F, light and opacity of smoke, as in `fire`.
    uint32_t smoke;

    /// RGBA32F, light and opacity of dust, as in `fire`.
    uint32_t dust;

    /// R32F, in meters in every context: transmittance-weighted distance of the media; +inf where there are
    /// no media.
    uint32_t depth;

    /// R32F [1] optical depth through all media.
    uint32_t opticalDepth;

    /// RGBA32F, the sum of the three layers.
    uint32_t media;

    /// Reserved; 0.
    uint32_t reserved;
} FxLayerTextures;

/// Outputs of the last frame: GL names; 0 if settings.outputs does not include the output, or if no effect
/// was drawn. Fill structSize with sizeof before the call. The textures belong to the view and are valid
/// until its next fxView_Render(). Texels are arranged as in the target. Distances are measured from the eye
/// along the ray through the center of the pixel. Meshes and other opaque particles are included, surfaces of
/// the host are not.
typedef struct FxOutputTextures
{
    /// Set by the caller.
    uint32_t structSize;

    /// RG32UI, FxInstanceId::bits of the instance that contributes most to the pixel: low 32 bits in red,
    /// high 32 bits in green; 0 where the opacity is below 0.01.
    uint32_t instanceId;

    /// RG32F [pixel] mean displacement, since the last frame, of all particles seen in the pixel: red to the
    /// right, green upwards; 0 where there is no instance.
    uint32_t motion;

    /// R32F, in meters in every context: distance at which the optical depth reaches 0.01; +inf where the
    /// optical depth stays below 0.01.
    uint32_t firstDepth;

    /// R32F, in meters in every context: mean distance of the particles seen in the pixel; +inf where there
    /// are no particles.
    uint32_t meanDepth;

    /// R32F [1] optical depth of all media up to the first opaque surface.
    uint32_t opticalDepth;
} FxOutputTextures;

/// Creates a view of a scene. [GL thread]
/// @param settings null for the defaults
/// @param outView  receives the view; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, out of range, or a scene of another context),
///         FX_ERROR_VERSION, FX_ERROR_NO_GL, FX_ERROR_WRONG_THREAD, FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxCreateView(FxContext* context, FxScene* scene, const FxViewSettings* settings,
                             FxView** outView);

/// Destroys a view and its textures. Null is allowed and does nothing. [GL thread]
/// @return FX_OK, FX_ERROR_WRONG_THREAD or FX_ERROR_RE_ENTRANT (nothing was destroyed)
FX_API FxResult fxDestroyView(FxView* view);

/// Changes the settings from the next frame on. [GL thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member), FX_ERROR_VERSION,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_SetSettings(FxView* view, const FxViewSettings* settings);

/// Draws the scene, interpolated between its last two steps, over the host's picture. Targets are checked in
/// frames that draw; a frame without visible effects makes no GL call. Transform feedback must be paused or
/// ended. Active queries of the host count the draws of the view, and pending errors of glGetError are lost.
/// [GL thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member, the value and the remedy; also for
///         targets that the view cannot read or write correctly), FX_ERROR_VERSION, FX_ERROR_GL_FAILED,
///         FX_ERROR_GL_LOST (see fxContext_RestoreGl), FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
///         FX_ERROR_OUT_OF_MEMORY. On failure the picture and the GL state do not change.
FX_API FxResult fxView_Render(FxView* view, const FxFrameDef* frame);

/// Draws both eyes of a head-mounted or stereoscopic display, each over its own picture. Both eyes show the
/// same moment. Blobs are gathered and shaded once, particles are uploaded and computed on the GPU once, and
/// light slices are filled once; sorting and drawing are done for each eye. The picture of an eye is that of
/// fxView_Render() with its frame, except for what follows the first eye: level of detail, the widening of
/// blobs below a pixel, the direction in which media are lit, and the strength of glare unless resetHistory
/// is 1. Eyes are some centimeters apart, so that most effects differ by less than 1/255, and small
/// bright blobs by 2/255.
/// settings.budgetMilliseconds and times of quality are those of the first eye. Counters of passes, draw
/// calls, GL calls, programs, uploads and sorting are sums, other counters are those of the second eye.
/// settings.layerOutputs and settings.outputs must be 0. [GL thread]
/// @param first  frame of one eye, also with moment, deltaTime, resetHistory and holdQuality of both
/// @param second frame of the other eye; it may name the same targets at another viewport
/// @return as fxView_Render(). If the second eye fails after its arguments were found valid, the picture of
///         the first eye has changed
FX_API FxResult fxView_RenderStereo(FxView* view, const FxFrameDef* first, const FxFrameDef* second);

/// Shows another scene of the same context from the next frame on. Settings and lights of the view are kept.
/// What belongs to the last scene, such as the history of glare, impostors and layer textures, is released.
/// [GL thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, or a scene of another context), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. On failure the view does not change.
FX_API FxResult fxView_SetScene(FxView* view, FxScene* scene);

/// Reads the counters of the last frame. [GL thread]
/// @param ioStatistics structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetStatistics(FxView* view, FxViewStatistics* ioStatistics);

/// Reads the layer textures of the last frame. [GL thread]
/// @param ioTextures structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetLayerTextures(FxView* view, FxLayerTextures* ioTextures);

/// Reads the outputs of the last frame. [GL thread]
/// @param ioTextures structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
/// FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetOutputTextures(FxView* view, FxOutputTextures* ioTextures);

/// Reads the number of passes of the last frame. [GL thread]
/// @param outCount receives the number; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetPassCount(FxView* view, uint32_t* outCount);

/// Reads the name of one pass of the last frame, in order of execution. [GL thread]
/// @param index    0..fxView_GetPassCount() - 1
/// @param buffer   receives the name, zero-terminated and cut to fit; untouched on failure
/// @param capacity [byte] of buffer, > 0
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetPassName(FxView* view, uint32_t index, char* buffer, size_t capacity);

/// Names a GL state that fxView_Render() may leave changed when saveState is 0. [any]
/// @param index 0, 1, 2, ...
/// @return a constant string, or null when index is past the end
FX_API const char* fxGetTouchedGlState(uint32_t index);

#ifdef __cplusplus
}
#endif

#endif
