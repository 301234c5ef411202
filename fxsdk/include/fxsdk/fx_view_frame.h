/// @file fx_view_frame.h
/// Camera and targets of one frame, an argument of fxView_Render(). fx_view.h includes this header.
///
/// Ownership: the host owns the textures and framebuffers that a frame names. Formats of targets:
/// docs/howto/host-targets.md.
#ifndef FXSDK_FX_VIEW_FRAME_H
#define FXSDK_FX_VIEW_FRAME_H

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
    /// Write into draw buffer 0 of `framebuffer`: the first color attachment unless glDrawBuffer chose
    /// another. Framebuffer 0 is the window. Other attachments do not change. With a colorTexture, the
    /// picture is read from the texture and written completely. Without a colorTexture, and with
    /// FX_TARGET_LINEAR, the media are blended over the framebuffer, which is not read: there is no heat
    /// shimmer, no glare and no tone mapping. With a display encoding, the framebuffer is read by a copy, and
    /// shimmer and glare are drawn.
    FX_TARGET_FRAMEBUFFER = 1
};

/// Values of FxFrameDef::targetEncoding: meaning of red, green and blue in the color targets.
///
/// With a display encoding, the view decodes the picture to linear light, draws effects in light, and encodes
/// the pixels that effects change. Effects are tone-mapped: settings.dazzleWhite is the exposed value that is
/// displayed as 1, with the shoulder of settings.toneMap below it. The picture is not tone-mapped again.
/// Pixels that no effect changes keep their bits.
typedef enum FxTargetEncoding
{
    FX_TARGET_LINEAR = 0,       ///< linear light, luminance [cd/m2] times exposure
    FX_TARGET_DISPLAY_SRGB = 1, ///< values 0..1 as a display shows them, encoded by the curve of sRGB
    FX_TARGET_DISPLAY_GAMMA = 2 ///< values 0..1 as a display shows them, encoded by a gamma of 2.2
} FxTargetEncoding;

/// Values of FxFrameDef::rangePart: which call of a frame this is. A frame with transparent surfaces of the
/// host is drawn by several calls, one for each range of depth between them, the farthest first.
enum
{
    FX_RANGE_ONLY = 0,  ///< the only call of the frame
    FX_RANGE_FIRST = 1, ///< the first call, of the farthest range; NEXT or LAST follows
    FX_RANGE_NEXT = 2,  ///< neither the first nor the last call
    FX_RANGE_LAST = 3   ///< the last call, of the nearest range
};

/// One frame. Fill with fxDefaultFrameDef(), then set camera and target.
/// The picture fills the target from its lower left corner, or from viewportX, viewportY; the host's depth
/// range is 0 to 1.
typedef struct FxFrameDef
{
    /// Set by fxDefaultFrameDef(); do not touch.
    uint32_t structSize;

    /// 1: camera cut; the adaptation of glare starts anew with this frame; default 0.
    uint32_t resetHistory;

    /// [m] world position that the matrices are relative to, each component within +-1e9; default 0. With an
    /// origin near the camera, single precision suffices far from the origin of the world.
    double origin[3];

    /// Matrix from world coordinates minus `origin` to eye coordinates, column-major; rigid (columns
    /// orthonormal within 1e-3); default identity. In eye coordinates, x is right, y is up, and the camera
    /// looks along -z, in units of the host, whatever the axes of the world. With left-handed axes of
    /// FxContextDef, the determinant of the matrix is therefore -1.
    float view[16];

    /// Matrix from eye to clip coordinates, column-major, right-handed; perspective (elements 11 and 15 are
    /// -1 and 0) or orthographic (0 and 1). An infinite far plane, off-center projections, jitter and
    /// mirroring are allowed; depthConvention states to which value near maps. Required: the default,
    /// identity, is refused.
    float projection[16];

    /// FX_DEPTH_...; default FX_DEPTH_STANDARD.
    uint32_t depthConvention;

    /// 1: clip space depth is [0, w] (glClipControl GL_ZERO_TO_ONE); 0 (default): [-w, w].
    uint32_t zeroToOne;

    /// 1: the host's glClipControl is GL_UPPER_LEFT during the call; 0 (default): GL_LOWER_LEFT.
    uint32_t upperLeftOrigin;

    /// FX_TARGET_...; default FX_TARGET_TEXTURE.
    uint32_t target;

    /// GL name of a GL_TEXTURE_2D or GL_TEXTURE_2D_MULTISAMPLE holding the opaque picture in targetEncoding,
    /// red, green and blue as floats or normalized; textures of sRGB formats hold sRGB-encoded values; 0 only
    /// with FX_TARGET_FRAMEBUFFER.
    uint32_t colorTexture;

    /// GL name of a GL_TEXTURE_2D or GL_TEXTURE_2D_MULTISAMPLE with the depth of the opaque picture, one
    /// texel for each pixel; of several samples, one is used; 0 (default): no surface occludes the effects.
    /// Particles on the GPU collide with this depth if their preset has an obstacle of the shape "depth".
    uint32_t depthTexture;

    /// GL name of the framebuffer, with FX_TARGET_FRAMEBUFFER or depthFromFramebuffer; default 0, the window.
    uint32_t framebuffer;

    /// [pixel] width of the frame, 1..16384 and within the target.
    int32_t width;

    /// [pixel] height of the frame, 1..16384 and within the target.
    int32_t height;

    /// 1: the frame is not typical, because the host loads, seeks or catches up; default 0. Quality does not
    /// change, and the cost model ignores the time of the frame.
    uint32_t holdQuality;

    /// [s] 0..1e6, time since the last frame of this view, used only for adaptation; default 1/60.
    double deltaTime;

    /// GL name of a GL_TEXTURE_2D with depth: the host's shadow map of the sun. By this map, opaque surfaces
    /// cast shadows on media. 0 (default): the sun reaches all media.
    uint32_t sunShadowTexture;

    /// FX_DEPTH_... of sunShadowTexture; default FX_DEPTH_STANDARD.
    uint32_t sunShadowConvention;

    /// Matrix from world coordinates minus `origin` to texture coordinates and stored depth of
    /// sunShadowTexture, each 0..1, column-major, affine. The matrix includes the bias against
    /// self-shadowing. Default identity.
    float sunShadowMatrix[16];

    /// [m] 0..100, radius of the soft edge of the sun's shadow on media; default 0.1.
    float sunShadowEdge;

    /// FX_TARGET_LINEAR (default), FX_TARGET_DISPLAY_SRGB or FX_TARGET_DISPLAY_GAMMA.
    uint32_t targetEncoding;

    /// 1: depth is read from the depth attachment of `framebuffer`, whatever `target` is: a window, a
    /// renderbuffer or a texture, of one or several samples; depthTexture must be 0. 0 (default): depth is
    /// depthTexture.
    uint32_t depthFromFramebuffer;

    /// [pixel] >= 0, lower left corner of the frame in its targets: color, depth and framebuffer; default 0.
    /// The frame covers `width` x `height` pixels from there, as after glViewport(viewportX, viewportY,
    /// width, height). Pixels outside of the frame do not change.
    int32_t viewportX;
    int32_t viewportY; ///< [pixel] see viewportX

    /// 1: the host's scissor test of viewport 0, if it is enabled during the call, also limits what the view
    /// writes to its target; 0 (default): the view writes the whole frame.
    uint32_t keepScissor;

    /// [1] 1..1e6, exposed value that the host has drawn as 1, with a display encoding: 1 for colors that are
    /// clamped, more for pictures that are tone-mapped. It decides how effects attenuate bright backgrounds;
    /// default 2.
    float displayWhite;

    /// FX_RANGE_...; default FX_RANGE_ONLY. From FIRST to LAST, moment, camera, size and resetHistory are the
    /// same; lists, uploads, light slices, fields and networks are those of the first call. Heat shimmer,
    /// glare, tone mapping and the activation overlay are drawn by LAST and ONLY, over the whole picture.
    /// A call of fxView_SetSettings(), fxView_SetLights(), fxView_SetScene(), fxView_PrepareLights() or
    /// fxView_RenderStereo() ends the frame, and so does a call that fails.
    uint32_t rangePart;

    /// [m] 0..1e9, depth along the view axis, from the eye plane, from which on effects are drawn; 0
    /// (default): from the near plane on. Media and opaque particles are cut there; what a sprite, ribbon or
    /// impostor covers is divided within its softness. Shadows, light and heat shimmer do not depend on the
    /// range.
    float rangeNear;

    /// [m] above rangeNear: depth up to which effects are drawn; exactly 1e9 in any unit (default), or at
    /// least 1e9 m: all of them.
    float rangeFar;

    /// Bits of which an instance needs one to be seen, see FxInstanceDef::visibilityMask; default 0xFFFFFFFF.
    /// Other instances are not drawn by this frame, and cast neither light nor shadows in it.
    uint32_t visibilityMask;

    /// Reserved; 0.
    uint32_t reserved;
} FxFrameDef;

/// A frame with its camera at the origin; the target has to be set.
static inline FxFrameDef fxDefaultFrameDef(void)
{
    FxFrameDef def = FX_ZEROED;
    def.structSize = sizeof(FxFrameDef);
    for (int i = 0; i < 16; i += 5)
        def.view[i] = def.projection[i] = def.sunShadowMatrix[i] = 1.0f;
    def.deltaTime = 1.0 / 60.0;
    def.sunShadowEdge = 0.1f;
    def.displayWhite = 2.0f;
    def.rangeFar = 1e9f;
    def.visibilityMask = 0xFFFFFFFFu;
    return def;
}

#ifdef __cplusplus
}
#endif

#endif
