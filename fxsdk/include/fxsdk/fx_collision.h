/// @file fx_collision.h
/// Geometry of the host that effects collide with: a mesh, or a callback. fx_scene.h includes this header.
///
/// Threads: [scene thread] for all functions; the callback runs on several threads. Ownership: the library
/// copies the mesh; the host keeps the callback alive.
#ifndef FXSDK_FX_COLLISION_H
#define FXSDK_FX_COLLISION_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Triangles of static geometry that effects collide with. Fill with fxDefaultCollisionMesh(), then set
/// positions and vertexCount.
typedef struct FxCollisionMesh
{
    /// Set by fxDefaultCollisionMesh(); do not touch.
    uint32_t structSize;

    /// [m] 1e-3..1e3, cell size of the grid that represents the mesh; smaller details are lost. 0
    /// (default): the smallest size for which the grid has at most four million cells.
    float cellSize;

    /// [m] world position that positions are relative to, each component within +-1e9; default 0.
    double origin[3];

    /// [m] x, y, z of each vertex, each component within +-1e5; read during the call only.
    const float* positions;

    /// Three indices per triangle, counter-clockwise as seen from outside, also if the host's axes are
    /// left-handed; read during the call only. Null (default): three consecutive vertices per triangle.
    const uint32_t* indices;

    /// Number of vertices, 3..2^24.
    uint32_t vertexCount;

    /// Number of indices: three times the number of triangles, which is at most 2^22; 0 without indices.
    uint32_t indexCount;
} FxCollisionMesh;

/// An empty mesh.
static inline FxCollisionMesh fxDefaultCollisionMesh(void)
{
    FxCollisionMesh mesh = FX_ZEROED;
    mesh.structSize = sizeof(FxCollisionMesh);
    return mesh;
}

/// Callback of the host: intersects the path of one particle with the host's geometry. The callback must not
/// throw, block for long, or change the geometry.
///
/// Threads: several threads may call the callback at the same time, during fxScene_Update() or
/// fxScene_SeekInstance(): worker threads of the context and the scene thread. The callback must not call
/// functions of this scene. Such calls change nothing. They fail with FX_ERROR_RE_ENTRANT on the scene thread
/// and with FX_ERROR_WRONG_THREAD on other threads. Within one API call, equal arguments must give equal
/// results. For bit-equal results on every machine, equal arguments must always give equal results. When
/// hidden instances are replayed, the callback receives past paths.
/// @param user FxContactHook::user
/// @param from, to [m] world, a straight path of at most one step
/// @param outShare  [1] 0..1, fraction of the path before the contact
/// @param outNormal surface normal at the contact in world space, of any length above 0, facing against the
///                  path
/// @return 0: no contact, the outputs are ignored; 1: contact
typedef int (*FxContactFunction)(void* user, const double from[3], const double to[3], float* outShare,
                                 float outNormal[3]);

/// Geometry of the host behind a callback, for presets with an obstacle of the shape "hook". Fill with
/// fxDefaultContactHook().
typedef struct FxContactHook
{
    uint32_t structSize;    ///< set by fxDefaultContactHook(); do not touch
    uint32_t reserved;      ///< 0
    FxContactFunction meet; ///< required
    void* user;             ///< passed to `meet`; default null
} FxContactHook;

/// A hook without a function.
static inline FxContactHook fxDefaultContactHook(void)
{
    FxContactHook hook = FX_ZEROED;
    hook.structSize = sizeof(FxContactHook);
    return hook;
}

/// Replaces, from the next step on, the geometry with which gases, fragments and bouncing particles collide.
/// Closed surfaces are solid. Behind an open surface, a layer two cells thick is solid; the front is the side
/// from which vertices run counter-clockwise. Walls thinner than a cell are thickened, so that no particle
/// tunnels through.
///
/// This call converts the mesh to a signed distance field on the threads of the context. The conversion takes
/// seconds for a large mesh. It needs 4 bytes per cell (at most 64 MiB) and, during the call, 300 bytes per
/// triangle. With a mesh, a step takes a few samples of the field per particle and allocates nothing.
/// Instances that collide share one simulation only if they have equal position, rotation and scale. A saved
/// state contains a hash of the mesh, not the mesh itself. [scene thread]
/// @param mesh read during the call only; null: no geometry
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, not finite or out of range; an index beyond the vertices;
///         no triangle with an area), FX_ERROR_VERSION (structSize), FX_ERROR_CAPACITY (more than 2^24 cells;
///         the message states the number of cells), FX_ERROR_OUT_OF_MEMORY, FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT. A failure leaves the scene as it was.
FX_API FxResult fxScene_SetCollisionMesh(FxScene* scene, const FxCollisionMesh* mesh);

/// Sets the contact callback from the next step on. The callback is called for presets with an obstacle of
/// the shape "hook". Saved states do not contain the callback: set it before a state is restored. [scene
/// thread]
/// @param hook null removes the callback. The function must be callable until another function is set or the
///             scene is destroyed
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null or without a function), FX_ERROR_VERSION (structSize),
///         FX_ERROR_OUT_OF_MEMORY, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT. A failure leaves the scene
///         as it was.
FX_API FxResult fxScene_SetContactHook(FxScene* scene, const FxContactHook* hook);

#ifdef __cplusplus
}
#endif

#endif
