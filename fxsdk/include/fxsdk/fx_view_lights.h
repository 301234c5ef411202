/// @file fx_view_lights.h
/// Lights of a view: lights of the host for the media, lights of the effects for the host's level, and
/// shadows of media on the host's surfaces. Include this to connect effects with the lighting of a game;
/// docs/howto/light-slices.md shows how.
///
/// Threads: [GL thread] for all functions. Ownership: the library copies all arguments; textures belong to
/// the view.
#ifndef FXSDK_FX_VIEW_LIGHTS_H
#define FXSDK_FX_VIEW_LIGHTS_H

#include "fxsdk/fx_view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Maximum number of lights of fxView_SetLights().
#define FX_MOST_LIGHTS 8

/// Values of the argument `kind` of fxView_GetMediaShadow(), and of FxLightCost::kind.
enum
{
    FX_LIGHT_SUN = 0,    ///< FxViewSettings::sunDirection; index 0
    FX_LIGHT_HOST = 1,   ///< index in the array of fxView_SetLights()
    FX_LIGHT_EFFECT = 2, ///< index of fxView_GetEffectLight()
    FX_LIGHT_SKY = 3     ///< sky and ground; index 0, only in FxLightCost
};

/// A point light, a spherical light or a spotlight. Fill with fxDefaultLight(), then set position and
/// intensity. The illuminance in lx of a surface that faces the light at the distance d is intensity / (d^2 +
/// radius^2), with d and radius in meters. Intensities do not depend on the host's units of length.
typedef struct FxLight
{
    /// Set by fxDefaultLight(); do not touch.
    uint32_t structSize;

    /// [m] 0..1e4, radius of a spherical light; 0: a point light; default 0.05.
    float radius;

    /// [m] world position, each component within +-1e9; default 0.
    double position[3];

    /// [cd] 0..1e9, maximum luminous intensity over all directions, linear Rec. 709; default 0.
    float intensity[3];

    /// The direction in which a spot shines, unit (length within 1e-3 of 1); default 0, -1, 0.
    float axis[3];

    /// [rad] 0..pi, angle to the axis up to which a spot has its full intensity; default pi.
    float innerConeAngle;

    /// [rad] innerConeAngle..pi, angle to the axis beyond which a spot emits no light; pi (default): light in
    /// all directions. Between both angles, the intensity is a smooth step.
    float outerConeAngle;
} FxLight;

/// A light at the origin with the intensity 0.
static inline FxLight fxDefaultLight(void)
{
    FxLight light = FX_ZEROED;
    light.structSize = sizeof(FxLight);
    light.radius = 0.05f;
    light.axis[1] = -1.0f;
    light.innerConeAngle = light.outerConeAngle = 3.14159265f;
    return light;
}

/// Parameters by which a shader computes the shadow of media in one light. Fill structSize with sizeof before
/// the call. The members from `right` on are a std140 uniform block of 13 vec4 for the GLSL of
/// fxGetMediaShadowGlsl(), which explains each member. Positions are relative to FxFrameDef::origin.
typedef struct FxMediaShadow
{
    /// Set by the caller.
    uint32_t structSize;

    /// GL name of a GL_TEXTURE_2D, RG32F, with linear filters, valid until the next frame of the view. 0:
    /// media cast no shadow in this light; then all members below are 0, and the GLSL reads no texture.
    uint32_t texture;

    /// Rows of the matrix that gives the texel along x; the GLSL explains its use.
    float right[3][4];

    /// Rows of the matrix that gives the texel along y.
    float up[3][4];

    /// Rows of the matrix that gives the plane.
    float along[3][4];

    /// [texel] positions of the planes in the texture.
    float tiles[3][4];

    /// xyz [m]: position of a light that is not the sun; w: 1 for a point light, 0 for the sun.
    float place[4];
} FxMediaShadow;

/// Cost of a light in media. Fill structSize with sizeof before the call.
typedef struct FxLightCost
{
    /// Set by the caller.
    uint32_t structSize;

    /// FX_LIGHT_...
    uint32_t kind;

    /// Index of the light among the lights of its kind.
    uint32_t index;

    /// Number of planes of its light slices; 0: media cast no shadows in this light. Point lights are sorted
    /// by decreasing brightness, and the first FxViewSettings::castingLights have planes.
    uint32_t planes;

    /// [byte] memory of the planes.
    uint64_t bytes;

    /// Number of rays along which media are integrated to fill the planes. The time grows with this number;
    /// `fx bench slices` measures it.
    uint64_t rays;

    /// [ms] time in which the last timed frame filled the planes of this light. The measured time of all
    /// planes is divided among the lights in proportion to their rays. Frames are timed while
    /// FxViewSettings::budgetMilliseconds is set. 0: no timed frame has filled planes.
    float milliseconds;
    uint32_t reserved; ///< 0
} FxLightCost;

/// Replaces the host's lights that illuminate media, from the next frame on. The lights that illuminate the
/// media most cast shadows through media (FxViewSettings::castingLights). Other lights cast no shadows. [GL
/// thread]
/// @param lights `count` lights one after the other; may be null when count is 0; then the host has no lights
/// @param count  0..FX_MOST_LIGHTS
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member, the value and the remedy),
///         FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT. A failure changes
///         nothing.
FX_API FxResult fxView_SetLights(FxView* view, const FxLight* lights, uint32_t count);

/// Gathers the effects of a frame and fills the planes of its lights, before the host draws its level. Call
/// this function and fxView_GetMediaShadow(), draw the level, then call fxView_Render() with the same frame.
/// fxView_Render() then reuses the prepared work and shows the prepared moment, even if the scene was updated
/// in between. The target members of the frame may be 0 here; a frame with another camera or size is gathered
/// again. For a scene without effects, the function makes no GL call. The time of this call is not part of
/// FxViewSettings::budgetMilliseconds. [GL thread]
/// @return the codes of fxView_Render(). A failure changes nothing, and the next frame is drawn without
///         preparation.
FX_API FxResult fxView_PrepareLights(FxView* view, const FxFrameDef* frame);

/// Reads the shadow that media cast in a light of the frame that was prepared or rendered last. A frame
/// without fxView_PrepareLights() has shadows only if media are in view. [GL thread]
/// @param kind     FX_LIGHT_...
/// @param index    index of the light; a light that does not exist has no shadow
/// @param ioShadow structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetMediaShadow(FxView* view, uint32_t kind, uint32_t index, FxMediaShadow* ioShadow);

/// GLSL 4.20 source for shaders of the host, without #version. The source contains the struct FxMediaShadow
/// and the function `vec3 fxMediaTransmittance(sampler2D planes, FxMediaShadow shadow, vec3 p)`. The function
/// returns the fraction of a light that media transmit to a position p [m] relative to the frame's origin.
/// [any]
/// @return a constant string
FX_API const char* fxGetMediaShadowGlsl(void);

/// Reads the number of lights of the effects (fire, hot gas, luminous particles), at most 4, of the frame
/// that was prepared or rendered last. [GL thread]
/// @param outCount receives the number; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetEffectLightCount(FxView* view, uint32_t* outCount);

/// Reads a light of the effects, brightest light first, for the illumination of the host's level. Views
/// already illuminate media by the lights of effects: do not pass these lights to fxView_SetLights(). [GL
/// thread]
/// @param index   0..fxView_GetEffectLightCount() - 1
/// @param ioLight structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetEffectLight(FxView* view, uint32_t index, FxLight* ioLight);

/// Reads the number of lights that illuminate media in the frame that was prepared or rendered last. These
/// lights are the sun, the lights of the host and of the effects, and the sky if it has planes. [GL thread]
/// @param outCount receives the number, at most 14; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetLightCostCount(FxView* view, uint32_t* outCount);

/// Reads the cost of one light. [GL thread]
/// @param index  0..fxView_GetLightCostCount() - 1: the sun, then point lights by decreasing illumination of
///               the media, then the sky
/// @param ioCost structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetLightCost(FxView* view, uint32_t index, FxLightCost* ioCost);

#ifdef __cplusplus
}
#endif

#endif
