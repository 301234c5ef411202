/// @file fx_snapshot.h
/// Snapshots give the particles of a scene to hosts that draw or analyze the particles, with or without GL.
///
/// A snapshot holds the last two steps of a scene as lists of groups. A group is the output of one solver of
/// one instance: columns of numbers, an id per element, and a placement. An element has the same id in both
/// steps. The placement maps local to world coordinates: world = position + rotation * (scale * local).
/// With units or axes of the host (FxContextDef), placements, bounds, columns and constants are in them: [m],
/// [m/s] and [m2] count units of the host, and local axes are those of the host. Each acquired snapshot is
/// then copied.
/// Threads: everything here may be called from any thread, also while the scene thread updates the scene.
/// Ownership: pointers into a snapshot stay valid until the snapshot is released. At most 16 snapshots of a
/// scene are held at once.
#ifndef FXSDK_FX_SNAPSHOT_H
#define FXSDK_FX_SNAPSHOT_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Selects one of the two steps of a snapshot.
typedef enum FxSnapshotStep
{
    FX_SNAPSHOT_NEWER = 0,                 ///< the last step
    FX_SNAPSHOT_OLDER = 1,                 ///< the step before the last step
    FX_SNAPSHOT_STEP_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never valid
} FxSnapshotStep;

/// Contents of a snapshot. Fill structSize with sizeof before the call.
typedef struct FxSnapshotInfo
{
    /// Set by the caller.
    uint32_t structSize;

    /// Number of groups of the newer step.
    uint32_t groupsNewer;

    /// Number of groups of the older step; 0 before the second step.
    uint32_t groupsOlder;

    /// Reserved; 0.
    uint32_t reserved;

    /// [tick] end of the newer step; while no instance is visible, the end of an earlier step.
    int64_t tickNewer;

    /// [tick] end of the older step.
    int64_t tickOlder;

    /// [0, 1) position of the scene time between the two steps: 0 is the older, 1 the newer.
    double interpolation;
} FxSnapshotInfo;

/// One group. Fill structSize with sizeof before the call.
typedef struct FxSnapshotGroup
{
    uint32_t structSize;   ///< set by the caller
    uint32_t count;        ///< number of elements
    const char* kind;      ///< name of the kind, such as "blob"; constant string
    FxInstanceId instance; ///< instance of the particles; may have been destroyed since
    uint32_t solver;       ///< index of the solver in its preset
    float scale;           ///< [1] scale of the placement, > 0
    double position[3];    ///< [m] world position of the placement
    float rotation[4];     ///< rotation of the placement, unit quaternion x, y, z, w
    float boundsMin[3];    ///< [m] lower corner of the local bounds of all elements with their radii
    float boundsMax[3];  ///< [m] upper corner of the local bounds; below boundsMin when there are no elements
    const uint64_t* ids; ///< `count` ascending ids; null if the kind has no ids (docs/conventions.md)
    const float* constants; ///< `constantCount` values shared by all elements, see docs/conventions.md
    uint32_t constantCount; ///< number of constants of the kind
    uint32_t columnCount;   ///< number of columns of the kind
} FxSnapshotGroup;

/// One column of a group. Fill structSize with sizeof before the call.
typedef struct FxSnapshotColumn
{
    /// Set by the caller.
    uint32_t structSize;

    /// Number of elements.
    uint32_t count;

    /// Name of the column, such as "radius"; constant string.
    const char* name;

    /// SI unit such as "m", "1" for none; constant string.
    const char* unit;

    /// `count` floats; null when the column has 64-bit values or does not exist (count is 0).
    const float* values;

    /// `count` 64-bit values; null when the column has floats or does not exist.
    const uint64_t* values64;
} FxSnapshotColumn;

/// Acquires a snapshot of the newest two steps of a scene. Release it soon: a held snapshot occupies memory.
/// [any]
/// @param outSnapshot receives the id; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_CAPACITY (16 snapshots are held)
FX_API FxResult fxScene_AcquireSnapshot(FxScene* scene, FxSnapshotId* outSnapshot);

/// Releases a snapshot; its id is stale and its pointers are invalid afterwards. [any]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID
FX_API FxResult fxScene_ReleaseSnapshot(FxScene* scene, FxSnapshotId snapshot);

/// Reads the contents of a snapshot. [any]
/// @param ioInfo structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_VERSION (structSize)
FX_API FxResult fxScene_GetSnapshotInfo(FxScene* scene, FxSnapshotId snapshot, FxSnapshotInfo* ioInfo);

/// Describes one group of a snapshot. [any]
/// @param index   0..number of groups of the step - 1
/// @param ioGroup structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (step or index out of range), FX_ERROR_STALE_ID, FX_ERROR_VERSION
FX_API FxResult fxScene_GetSnapshotGroup(FxScene* scene, FxSnapshotId snapshot, FxSnapshotStep step,
                                         uint32_t index, FxSnapshotGroup* ioGroup);

/// Describes one column of a group, by position. [any]
/// @param column   0..columnCount - 1
/// @param ioColumn structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (step, group or column out of range), FX_ERROR_STALE_ID,
///         FX_ERROR_VERSION
FX_API FxResult fxScene_GetSnapshotColumn(FxScene* scene, FxSnapshotId snapshot, FxSnapshotStep step,
                                          uint32_t group, uint32_t column, FxSnapshotColumn* ioColumn);

/// Describes one column of a group, by name. [any]
/// @param name such as "x", "y", "z" [m], "radius" [m], "temperature" [K]
/// @return the codes of fxScene_GetSnapshotColumn(); FX_ERROR_NOT_FOUND when the kind has no such column
FX_API FxResult fxScene_FindSnapshotColumn(FxScene* scene, FxSnapshotId snapshot, FxSnapshotStep step,
                                           uint32_t group, const char* name, FxSnapshotColumn* ioColumn);

#ifdef __cplusplus
}
#endif

#endif
