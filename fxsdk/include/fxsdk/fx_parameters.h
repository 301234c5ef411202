/// @file fx_parameters.h
/// Parameters of a running instance. fx_scene.h includes this header.
///
/// Threads: [scene thread] for all functions, unless they state otherwise.
#ifndef FXSDK_FX_PARAMETERS_H
#define FXSDK_FX_PARAMETERS_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Names one parameter of a preset. All-zero means "none". A handle of a parameter that every preset has is
/// valid for all instances.
typedef struct FxParameterId
{
    uint64_t bits; ///< opaque
} FxParameterId;

/// Type of the value of a parameter, and of the memory from which it is read.
typedef enum FxParameterType
{
    FX_PARAMETER_FLOAT = 1,                 ///< one float
    FX_PARAMETER_FLOAT3 = 2,                ///< three floats
    FX_PARAMETER_BOOL = 3,                  ///< one uint32_t, 0 or 1
    FX_PARAMETER_TYPE_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never valid
} FxParameterType;

/// Properties of a parameter. Fill structSize with sizeof before the call.
typedef struct FxParameterInfo
{
    /// Set by the caller.
    uint32_t structSize;

    /// FxParameterType.
    uint32_t type;

    /// Handle of the parameter.
    FxParameterId parameter;

    /// Smallest value of a component.
    float minimum;

    /// Largest value of a component.
    float maximum;

    /// Value in fxDefaultInstanceDef(), with as many components as the type has; the others are 0.
    float defaultValue[4];

    /// Number of parameters of the preset.
    uint32_t count;

    /// Reserved; 0.
    uint32_t reserved;

    /// Name, zero-terminated.
    char name[64];

    /// SI unit such as "m/s", "1" for none; zero-terminated.
    char unit[16];
} FxParameterInfo;

/// Parameters that may change while an instance runs. Fill with fxDefaultInstanceParameters().
typedef struct FxInstanceParameters
{
    /// Set by fxDefaultInstanceParameters(); do not touch.
    uint32_t structSize;

    /// [1] 0..1000, multiplies future birth rates and injected energies; default 1.
    float intensity;

    /// [m/s] world, each component within +-1000, added to the wind of the preset; default 0.
    float wind[3];

    /// 0: no births, existing particles continue; 1 (default): births as in the preset.
    uint32_t emitting;

    /// [1] linear Rec. 709, each component 0..1; default 1. A filter in front of the effect's own light: the
    /// tint multiplies the albedo of media, their emission and the light of their black bodies, the colors of
    /// sprites, meshes and trails, and the light that the effect casts. Extinction, opacity and temperature
    /// do not change, so that 0 gives black soot of the same density. Snapshots, views and the reference
    /// renderer show the tint. The CPU computes emitters of a tinted instance that prefer the GPU.
    float tint[3];
} FxInstanceParameters;

/// Parameters that do not change the preset.
static inline FxInstanceParameters fxDefaultInstanceParameters(void)
{
    FxInstanceParameters parameters = {
        sizeof(FxInstanceParameters), 1.0f, {0.0f, 0.0f, 0.0f}, 1, {1.0f, 1.0f, 1.0f}};
    return parameters;
}

/// Finds a parameter of a preset by its name. Every preset has "intensity", "wind", "emitting" and "tint",
/// see FxInstanceParameters, and "speed", see fxScene_SetInstanceSpeed(). [any]
/// @param outParameter receives the handle; untouched on failure
/// @return FX_OK, FX_ERROR_NOT_FOUND (the message states the nearest name), FX_ERROR_INVALID_ARGUMENT,
///         FX_ERROR_STALE_ID (preset), FX_ERROR_RE_ENTRANT
FX_API FxResult fxFindParameter(FxContext* context, FxPresetId preset, const char* name,
                                FxParameterId* outParameter);

/// Reads properties of a parameter, to list the parameters of a preset. [any]
/// @param index  0..FxParameterInfo::count - 1; every preset has at least one
/// @param ioInfo structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, or no such parameter), FX_ERROR_STALE_ID (preset),
///         FX_ERROR_VERSION (structSize), FX_ERROR_RE_ENTRANT
FX_API FxResult fxGetParameterInfo(FxContext* context, FxPresetId preset, uint32_t index,
                                   FxParameterInfo* ioInfo);

/// Changes one parameter of an instance from the next step on, and no other. Equal to fxScene_SetParameters()
/// or fxScene_SetInstanceSpeed() with the present values of the others. [scene thread]
/// @param type  type of `value`; must be that of the parameter
/// @param value within the range of FxParameterInfo; read during the call only
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, another type, not finite or out of range; the message
///         names the parameter), FX_ERROR_STALE_ID (instance or parameter), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY (as fxScene_SetTransform)
FX_API FxResult fxScene_SetParameter(FxScene* scene, FxInstanceId instance, FxParameterId parameter,
                                     FxParameterType type, const void* value);

/// Reads the value that the host has set last, or that of the definition of the instance; with units of the
/// host (FxContextDef) rounded to and from meters. [scene thread]
/// @param type     type of `outValue`; must be that of the parameter
/// @param outValue receives the value; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null or another type), FX_ERROR_STALE_ID (instance or
/// parameter),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetParameter(FxScene* scene, FxInstanceId instance, FxParameterId parameter,
                                     FxParameterType type, void* outValue);

#ifdef __cplusplus
}
#endif

#endif
