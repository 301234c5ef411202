/// @file fxsdk.h
/// The whole C API of fxsdk: participating media and particle effects for OpenGL hosts.
///
/// The first effect: create a context (fx_context.h), load a preset (fx_preset.h), create a scene with an
/// instance (fx_scene.h), create a view (fx_view.h). In each frame, update the scene and render the view. See
/// examples/00_hello/main.c. fx_base.h states the rules of threads, ownership, units and errors for all
/// headers.
#ifndef FXSDK_FXSDK_H
#define FXSDK_FXSDK_H

#include "fxsdk/fx_activation.h"
#include "fxsdk/fx_base.h"
#include "fxsdk/fx_collision.h"
#include "fxsdk/fx_context.h"
#include "fxsdk/fx_defaults.h"
#include "fxsdk/fx_events.h"
#include "fxsdk/fx_motion.h"
#include "fxsdk/fx_parameters.h"
#include "fxsdk/fx_preset.h"
#include "fxsdk/fx_preset_load.h"
#include "fxsdk/fx_reload.h"
#include "fxsdk/fx_reserve.h"
#include "fxsdk/fx_scene.h"
#include "fxsdk/fx_snapshot.h"
#include "fxsdk/fx_state.h"
#include "fxsdk/fx_view.h"
#include "fxsdk/fx_view_frame.h"
#include "fxsdk/fx_view_lights.h"
#include "fxsdk/fx_view_quality.h"
#include "fxsdk/fx_view_setup.h"
#include "fxsdk/fx_visibility.h"

#endif
