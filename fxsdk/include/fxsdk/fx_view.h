/// @file fx_view.h
/// A view draws a scene into an image of the host's OpenGL 4.5 context. Include this to see effects.
///
/// Threads: everything here is [GL thread], the thread that created the context, unless a function says
/// otherwise. It may overlap with fxScene_Update on the scene thread. Ownership: the caller owns every
/// FxView*; a view owns its textures and the history of its exposure and glare. The host's textures and
/// framebuffers stay the host's.
///
/// GL state: with saveState = 1 no GL state differs after fxView_Render(), with 0 only those that
/// fxGetTouchedGlState() names. Transform feedback and conditional rendering must not be active. Clip
/// control is the frame definition's and never changed. Formats of targets: docs/howto/host-targets.md.
#ifndef FXSDK_FX_VIEW_H
#define FXSDK_FX_VIEW_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Values of FxFrameDef::depthConvention.
enum
{
    FX_DEPTH_STANDARD = 0, ///< near maps to the smaller value
    FX_DEPTH_REVERSED = 1  ///< near maps to 1, the far plane or infinity to 0
};

/// Values of FxFrameDef::target.
enum
{
    /// Draw over colorTexture.
    FX_TARGET_TEXTURE = 0,
    /// Write into the color attachment of framebuffer that its draw buffer 0 names, the first one unless
    /// glDrawBuffer said otherwise; 0 is the window. Other attachments stay as they are. With a colorTexture
    /// the picture is read from there and comes out complete. Without, the media are blended over what the
    /// framebuffer holds: it cannot be read, so there is no heat shimmer, no glare and no tone mapping.
    FX_TARGET_FRAMEBUFFER = 1
};

/// Values of FxViewSettings::billboardForm.
enum
{
    FX_BILLBOARD_PLANAR = 0,   ///< flat card: the classical particle, cheapest, cuts visibly at walls
    FX_BILLBOARD_CONSTANT = 1, ///< homogeneous ball
    FX_BILLBOARD_KERNEL = 2    ///< ball with the gas's own density profile, exact
};

/// Values of FxViewSettings::budgetClock.
enum
{
    FX_BUDGET_CLOCK_GPU = 0, ///< time of the GPU by timestamps, known some frames later; nothing waits
    /// Time on the calling thread from the call to the end of all GL work. Waits for the GPU (glFinish) up to
    /// six times a frame: for tools, software renderers and drivers without timestamps.
    FX_BUDGET_CLOCK_CPU = 1
};

/// Values of FxQualityReport::timing.
enum
{
    FX_TIMING_OFF = 0,        ///< there is no budget
    FX_TIMING_GPU = 1,        ///< FX_BUDGET_CLOCK_GPU
    FX_TIMING_CPU = 2,        ///< FX_BUDGET_CLOCK_CPU
    FX_TIMING_UNAVAILABLE = 3 ///< this OpenGL counts no time: quality is what the settings say
};

/// What stays the same from frame to frame. Fill with fxDefaultViewSettings(), then change what you need.
typedef struct FxViewSettings
{
    uint32_t structSize;     ///< set by fxDefaultViewSettings(); do not touch
    float exposureEv100;     ///< [EV100] -20..40; luminance is multiplied by 1 / (1.2 * 2^EV100); default 13
    float sunDirection[3];   ///< towards the sun, unit (length within 1e-3 of 1); default 0.3, 0.8, 0.52
                             ///< normalized
    float sunIlluminance[3]; ///< [lx] 0..1e6 on a plane facing the sun; default 0
    float skyLuminance[3];   ///< [cd/m2] 0..1e6 from everywhere; default 0
    float groundAlbedo;      ///< [1] 0..1, light that the ground throws back; default 0.2
    float
        shimmerStrength; ///< [1] 0..10, heat shimmer; 0 leaves the picture untouched, bit for bit; default 1
    float shimmerMaxOffset; ///< [pixel] 0..100 at a height of 720 pixels; default 12
    uint32_t dazzle;        ///< 1 (default): glare; 0: none
    float dazzleWhite;      ///< [1] 1e-3..1e6, exposed value at which the sensor saturates; default 8
    float dazzleA; ///< [1] sensor law f(over) = over (A + B exp(-C over)), over: mean overflow per pixel in
                   ///< units of dazzleWhite; A >= B exp(-2) and A >= -B; 1 spreads all of it; default 0.01, a
                   ///< clean lens
    float dazzleB; ///< [1] see dazzleA; default 0
    float dazzleC; ///< [1] >= 0, see dazzleA; default 1
    float dazzleRiseTime;   ///< [s] 0..60, time constant of growing glare; default 0.05
    float dazzleFallTime;   ///< [s] 0..60, time constant of fading glare; default 0.4
    uint32_t billboardForm; ///< FX_BILLBOARD_...; default FX_BILLBOARD_KERNEL
    uint32_t saveState;     ///< 1 (default): restore every GL state that is touched; 0: the host does
    uint32_t detail;        ///< 1 (default): procedural detail on particles; 0: bare kernels
    uint32_t toneMap;       ///< 1: write display-referred values; 0 (default): scene-linear
    uint32_t layerOutputs;  ///< 1: keep fire, smoke, dust, depth and optical depth as textures; default 0
    uint32_t
        countOverdraw; ///< 1: count fragments and read statistics back: costs a pass and a wait; default 0
    float layerScale;  ///< [1] 1 (default), 0.5 or 0.25: width and height at which particles are drawn, over
                       ///< those of the picture; edges of opaque surfaces stay sharp
    uint32_t fragmentBudget;  ///< 0 (default): none; otherwise a frame whose estimated fragments exceed it is
                              ///< drawn at a smaller layerScale, until 30 frames in a row were calm
    float budgetMilliseconds; ///< [ms] 0..1e4 that a frame of this view may take; 0 (default): quality is
                              ///< what these settings say. Otherwise it may fall below, never rise above
                              ///< them; what is simulated does not depend on it.
    uint32_t budgetClock;     ///< FX_BUDGET_CLOCK_...; default FX_BUDGET_CLOCK_GPU
    float lodBias; ///< [1] 0..256, level of detail: an effect keeps one particle, or piece of a ribbon,
                   ///< for so many pixels of its disc on the picture, at least twelve, which take over the
                   ///< light and the cover of the others without a jump; 1 is hardly to be seen, 16 is; 0
                   ///< (default): everything is drawn. Particles that the GPU computes are always drawn all.
                   ///< What is simulated does not depend on it.
    float lodImpostorPixels; ///< [pixel] 0..13, an effect whose ball has a smaller radius on the picture is
                             ///< drawn as a picture of itself, which is taken anew ten times a second while
                             ///< it changes, or when it is seen from elsewhere, and fades into the next; not
                             ///< with layerOutputs or orthographic projections. 0 (default): none
    /// 1: the boxes that instances are judged by are drawn over the picture, as of the last update: green
    /// active, yellow catching up, blue resting, gray not started, red hidden (out of view, too far or too
    /// small), orange occluded, magenta beyond the budget. Where the extent is not known the box is 1 m wide.
    /// Each update then visits all instances; for people who look for a fault. Default 0.
    uint32_t activationOverlay;
} FxViewSettings;

/// Daylight exposure, no lights of its own, everything on.
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
    return settings;
}

/// One frame. Fill with fxDefaultFrameDef(), then set camera and target.
/// The picture fills the target from its lower left corner (0, 0); the host's depth range is 0 to 1.
typedef struct FxFrameDef
{
    uint32_t structSize;   ///< set by fxDefaultFrameDef(); do not touch
    uint32_t resetHistory; ///< 1: camera cut, glare adapts from this frame; default 0
    double origin[3]; ///< [m] world position that the matrices are relative to, each within +-1e9; default 0.
                      ///< Near the camera, floats stay exact far from the world's center.
    float view[16];   ///< world minus origin to eye, column-major; rigid (columns orthonormal within 1e-3);
                      ///< default identity
    float projection[16]; ///< eye to clip, column-major, right-handed; perspective (elements 11 and 15 are -1
                          ///< and 0) or orthographic (0 and 1), infinite far plane, off-center, jitter and
                          ///< mirroring allowed; near maps to what depthConvention says; required: the
                          ///< default, identity, is refused
    uint32_t depthConvention; ///< FX_DEPTH_...; default FX_DEPTH_STANDARD
    uint32_t
        zeroToOne; ///< 1: clip space depth is [0, w] (glClipControl GL_ZERO_TO_ONE); 0 (default): [-w, w]
    uint32_t upperLeftOrigin; ///< 1: glClipControl GL_UPPER_LEFT, as it must be during the call; default 0
    uint32_t target;          ///< FX_TARGET_...; default FX_TARGET_TEXTURE
    uint32_t colorTexture; ///< GL name of a GL_TEXTURE_2D holding the opaque picture [cd/m2 times exposure],
                           ///< red, green and blue as floats or normalized; sRGB formats hold codes of it; 0
                           ///< only with FX_TARGET_FRAMEBUFFER
    uint32_t depthTexture; ///< GL name of a GL_TEXTURE_2D with its depth, one texel for each pixel; 0
                           ///< (default): nothing occludes. Particles on the GPU collide with it where their
                           ///< preset says so (shape "depth")
    uint32_t framebuffer;  ///< GL name, with FX_TARGET_FRAMEBUFFER; default 0
    int32_t width;         ///< [pixel] of the frame, 1..16384 and within the target
    int32_t height;        ///< [pixel] of the frame, 1..16384 and within the target
    uint32_t holdQuality; ///< 1: the host is loading, seeking or catching up: with a budget, quality stays as
                          ///< it is and the frame's time teaches nothing; default 0
    double deltaTime;     ///< [s] 0..1e6 since the last frame of this view, for adaptation only; default 1/60
} FxFrameDef;

/// A frame whose camera sits in the origin and whose target is missing.
static inline FxFrameDef fxDefaultFrameDef(void)
{
    FxFrameDef def = FX_ZEROED;
    def.structSize = sizeof(FxFrameDef);
    for (int i = 0; i < 16; i += 5)
        def.view[i] = def.projection[i] = 1.0f;
    def.deltaTime = 1.0 / 60.0;
    return def;
}

/// Counters of the last frame of a view; counts are exact. Fill structSize with sizeof before the call.
typedef struct FxViewStatistics
{
    uint32_t structSize;       ///< set by the caller
    uint32_t blobs;            ///< particles of media drawn
    uint32_t blobsCulled;      ///< particles of media outside the view
    uint32_t blobsNonFinite;   ///< particles of media dropped because a value was not finite
    uint32_t passes;           ///< passes executed
    uint32_t drawCalls;        ///< draws and dispatches
    uint32_t programsCompiled; ///< during the frame; 0 after fxContext_WarmUp()
    uint32_t reserved;         ///< 0
    uint64_t glCalls;          ///< calls into GL during the frame
    uint64_t textureBytes;     ///< [byte] of GPU memory that the view holds
    uint64_t coveredPixels;    ///< pixels, at layerScale, with at least one particle; with countOverdraw
    uint64_t shadedFragments;  ///< fragments of all particles, at layerScale; with countOverdraw
    double overflow[3];   ///< [1] glare: mean overflow per pixel in units of dazzleWhite, red, green, blue;
                          ///< with countOverdraw
    uint64_t allocations; ///< allocations from the context's allocator during the frame
    uint64_t estimatedFragments; ///< of the particles' covering rectangles, at layerScale; what
                                 ///< fragmentBudget is compared with
    float layerScale;            ///< [1] in use: that of the settings, or less to keep fragmentBudget
    uint32_t keptLists;     ///< 1: camera, settings and scene are as in the last frame, and what it gathered,
                            ///< sorted and uploaded served again; 0: not
    uint64_t uploadedBytes; ///< [byte] of particles, written to the GPU for the frame
    uint64_t sortedParticles; ///< put into an order of distance or age for the frame
    uint64_t unsharedBytes; ///< [byte] that the textures and buffers of the frame's passes would need if none
                            ///< shared its memory with another
    uint64_t sharedBytes;   ///< [byte] that they need: those that live at different times share
    uint32_t blobsThinned;  ///< particles that lodBias left to others
    uint32_t lodGroups[4];  ///< groups of particles of media by what lodBias leaves of them: all; at least
                            ///< half; at least an eighth; less
    uint32_t impostors;     ///< effects that lodImpostorPixels made pictures of themselves
    uint32_t impostorsTaken;   ///< pictures taken anew for the frame
    uint32_t gpuParticles;     ///< particles that the GPU computed for what was drawn, or would have if they
                               ///< lived: the capacity of their emitters
    uint64_t particlesThinned; ///< sprites, meshes and pieces of ribbons that lodBias left to others
    uint64_t keptRowBytes;   ///< [byte] of sprites, meshes and ribbons that stand still and were not written
                             ///< again, although others of the step were
    uint64_t sharedRowBytes; ///< [byte] of the same that were not written because another instance of the
                             ///< same simulation has them

    /// sprites of effects in view that were drawn, without those that lodBias left to others; of emitters on
    /// the GPU their capacity, as the CPU does not know how many of them live
    uint64_t sprites;

    /// meshes, counted as sprites are
    uint64_t meshes;

    /// pieces of ribbons between two points, counted as sprites are
    uint64_t ribbonPieces;
} FxViewStatistics;

/// Pictures that the last frame kept; GL names, 0 when settings.layerOutputs was 0. Fill structSize with
/// sizeof before the call. The textures belong to the view and are valid until its next fxView_Render().
typedef struct FxLayerTextures
{
    uint32_t structSize; ///< set by the caller
    uint32_t fire;  ///< RGBA32F [cd/m2 times exposure] that reaches the eye from fire; A: its visible share
    uint32_t smoke; ///< RGBA32F, the same of smoke
    uint32_t dust;  ///< RGBA32F, the same of dust
    uint32_t depth; ///< R32F [m] transmittance-weighted distance of the media; +inf where there is none
    uint32_t opticalDepth; ///< R32F [1] through all media
    uint32_t media;        ///< RGBA32F, the sum of the three layers
    uint32_t reserved;     ///< 0
} FxLayerTextures;

/// What the frame budget led to. Fill structSize with sizeof before the call.
typedef struct FxQualityReport
{
    uint32_t structSize;        ///< set by the caller
    uint32_t timing;            ///< FX_TIMING_...; OFF and UNAVAILABLE: what follows is 0
    float budgetMilliseconds;   ///< [ms] as asked for
    uint32_t hasMeasured;       ///< 1: a frame has finished and measuredMilliseconds is its time; 0: none yet
    float measuredMilliseconds; ///< [ms] of the last frame that is known to have finished
    float predictedMilliseconds; ///< [ms] that the last frame was expected to take
    float estimatedError;        ///< [1] mean error of the picture's light against the highest setting
    uint32_t saturated;          ///< 1: even the lowest settings are expected to exceed the budget
    uint32_t held;               ///< 1: the last frame was not to change quality
    uint32_t techniques;         ///< that fxView_GetQualityChoice() knows
    uint64_t switches;           ///< frames that changed a setting, since the calibration was set
} FxQualityReport;

/// What was chosen for one technique in the last frame. Fill structSize with sizeof before the call.
typedef struct FxQualityChoice
{
    uint32_t structSize;         ///< set by the caller
    uint32_t step;               ///< 0..steps - 1, cheapest first
    uint32_t steps;              ///< of the technique's ladder
    float cost;                  ///< [1] of the step, in units of the highest one's
    float error;                 ///< [1] of the step, against the highest one's picture
    float weight;                ///< [1] 0..1 about the share of the picture that the technique covers
    float predictedMilliseconds; ///< [ms] of the step in this scene
    uint32_t reserved;           ///< 0
    char technique[32];          ///< "media", "shimmer", "dazzle", or "other" for all that no setting changes
    char setting[96];            ///< for people, such as "particles 0.5, kernel, detail on"
} FxQualityChoice;

/// Creates a view of a scene. [GL thread]
/// @param settings null for the defaults
/// @param outView  receives the view; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, out of range, or a scene of another context),
/// FX_ERROR_VERSION,
///         FX_ERROR_NO_GL, FX_ERROR_WRONG_THREAD, FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxCreateView(FxContext* context, FxScene* scene, const FxViewSettings* settings,
                             FxView** outView);

/// Destroys a view and its textures. Null is allowed and does nothing. [GL thread]
/// @return FX_OK, FX_ERROR_WRONG_THREAD or FX_ERROR_RE_ENTRANT (nothing was destroyed)
FX_API FxResult fxDestroyView(FxView* view);

/// Changes the settings from the next frame on. [GL thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member), FX_ERROR_VERSION,
/// FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_SetSettings(FxView* view, const FxViewSettings* settings);

/// Draws the scene, as it is between its last two steps, over the host's picture. Textures and framebuffers
/// are looked at in frames that draw; a frame that draws nothing makes no GL call. Transform feedback must be
/// paused or ended, queries of the host that are active count what is drawn, and errors that glGetError would
/// have told are lost. [GL thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member, what was found, and what to do;
/// also of targets that would be read or drawn to wrongly), FX_ERROR_VERSION, FX_ERROR_GL_FAILED,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. On failure the picture and the
///         GL state are what the host left.
FX_API FxResult fxView_Render(FxView* view, const FxFrameDef* frame);

/// Reads the counters of the last frame. [GL thread]
/// @param ioStatistics structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
/// FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetStatistics(FxView* view, FxViewStatistics* ioStatistics);

/// Names the pictures that the last frame kept. [GL thread]
/// @param ioTextures structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
/// FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetLayerTextures(FxView* view, FxLayerTextures* ioTextures);

/// Counts the passes that the last frame executed. [GL thread]
/// @param outCount receives the number; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetPassCount(FxView* view, uint32_t* outCount);

/// Names one pass that the last frame executed, in order. [GL thread]
/// @param index    0..fxView_GetPassCount() - 1
/// @param buffer   receives the name, zero-terminated and cut to fit; untouched on failure
/// @param capacity [byte] of buffer, > 0
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetPassName(FxView* view, uint32_t index, char* buffer, size_t capacity);

/// Exchanges what the view knows of costs and errors: the text of a file that `fx calibrate` wrote. Without
/// it, views with a budget use a calibration that is built in. What was learned is forgotten. [GL thread]
/// @param text        UTF-8, need not be zero-terminated; not kept; null: the built-in one again
/// @param length      [byte] of text, 1..64 KiB; 0 with null
/// @param displayName stands for the file's name in messages; may be null
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_TOO_LARGE, FX_ERROR_PARSE, FX_ERROR_SCHEMA,
/// FX_ERROR_VERSION (the message names line, place and remedy; nothing has changed), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxView_SetQualityCalibration(FxView* view, const char* text, size_t length,
                                             const char* displayName);

/// Reads what the frame budget led to in the last frame. [GL thread]
/// @param ioReport structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
/// FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetQualityReport(FxView* view, FxQualityReport* ioReport);

/// Reads what was chosen for one technique in the last frame. [GL thread]
/// @param index    0..FxQualityReport::techniques - 1
/// @param ioChoice structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
/// FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetQualityChoice(FxView* view, uint32_t index, FxQualityChoice* ioChoice);

/// Names a GL state that fxView_Render() may leave changed when saveState is 0; the list is made from the
/// table that restores them when it is 1. [any]
/// @param index 0, 1, 2, ...
/// @return a constant string, or null when index is past the end
FX_API const char* fxGetTouchedGlState(uint32_t index);

#ifdef __cplusplus
}
#endif

#endif
