/// @file host_effects.h
/// The effects that all example hosts show: a campfire, sparks and an explosion. A game copies this file.
///
/// Threads: the GL thread.
#ifndef HOST_EFFECTS_H
#define HOST_EFFECTS_H

#include "fxsdk/fxsdk.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct HostEffects
{
    FxContext* context;
    FxScene* scene;
    FxView* view;
} HostEffects;

/// Creates context, scene, effects and view. The OpenGL context is current.
/// @param gl       finds functions of OpenGL, as the host's window library does
/// @param settings exposure, light and white of the host's target
/// @return 1; 0 after a failure, which fxGetLastErrorMessage() describes
int hostOpenEffects(HostEffects* effects, const FxGlLoader* gl, const FxViewSettings* settings);

/// Destroys all of it, while the OpenGL context is still current.
void hostCloseEffects(HostEffects* effects);

#ifdef __cplusplus
}
#endif

#endif
