/// @file fx_view_statistics.h
/// Counters of a view, read by fxView_GetStatistics(). fx_view.h includes this header.
///
/// Ownership: the caller owns the struct.
#ifndef FXSDK_FX_VIEW_STATISTICS_H
#define FXSDK_FX_VIEW_STATISTICS_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Counters of the last frame of a view; counts are exact. Fill structSize with sizeof before the call.
typedef struct FxViewStatistics
{
    /// Set by the caller.
    uint32_t structSize;

    /// Number of drawn particles of media.
    uint32_t blobs;

    /// Number of particles of media outside the view.
    uint32_t blobsCulled;

    /// Number of particles of media dropped because a value was not finite.
    uint32_t blobsNonFinite;

    /// Number of executed passes.
    uint32_t passes;

    /// Number of draws and dispatches.
    uint32_t drawCalls;

    /// Number of programs compiled during the frame; 0 after fxContext_WarmUp().
    uint32_t programsCompiled;

    /// Reserved; 0.
    uint32_t reserved;

    /// Number of calls into GL during the frame.
    uint64_t glCalls;

    /// [byte] size of the GPU memory that the view holds.
    uint64_t textureBytes;

    /// Number of pixels, at layerScale, with at least one particle. Counted only with countOverdraw.
    uint64_t coveredPixels;

    /// Number of fragments of all particles, at layerScale. Counted only with countOverdraw.
    uint64_t shadedFragments;

    /// [1] glare: mean overflow per pixel in units of dazzleWhite, red, green, blue. Counted only with
    /// countOverdraw.
    double overflow[3];

    /// Number of allocations from the context's allocator during the frame.
    uint64_t allocations;

    /// Estimated number of fragments of the particles' bounding rectangles, at layerScale; limited by
    /// fragmentBudget.
    uint64_t estimatedFragments;

    /// [1] layerScale in use: the value of the settings, or a smaller value to meet fragmentBudget.
    float layerScale;

    /// 1: the gathered, sorted and uploaded data of the last frame are reused, because camera, settings and
    /// scene are equal; 0: the data are not reused.
    uint32_t keptLists;

    /// [byte] size of the particle data uploaded to the GPU for the frame.
    uint64_t uploadedBytes;

    /// Number of particles sorted by distance or age for the frame.
    uint64_t sortedParticles;

    /// [byte] memory that the textures and buffers of the frame's passes would need without sharing of
    /// memory.
    uint64_t unsharedBytes;

    /// [byte] memory of the frame's textures and buffers when resources of disjoint lifetimes share memory.
    uint64_t sharedBytes;

    /// Number of particles of media that are not drawn because of lodBias.
    uint32_t blobsThinned;

    /// Number of groups of particles of media by the fraction of particles that lodBias keeps. The four
    /// elements count groups of which all, at least half, at least an eighth, or fewer particles are drawn.
    uint32_t lodGroups[4];

    /// Number of effects drawn as impostors.
    uint32_t impostors;

    /// Number of impostors re-rendered for the frame.
    uint32_t impostorsTaken;

    /// Number of particles computed on the GPU for the frame. An emitter counts with its capacity.
    uint32_t gpuParticles;

    /// Number of sprites, meshes and pieces of ribbons that are not drawn because of lodBias.
    uint64_t particlesThinned;

    /// [byte] size of the data of sprites, meshes and ribbons that were not uploaded again because they had
    /// not changed. Counted only in frames that upload other particles of the step.
    uint64_t keptRowBytes;

    /// [byte] size of the data of sprites, meshes and ribbons that were not uploaded because another instance
    /// of the same simulation has uploaded them.
    uint64_t sharedRowBytes;

    /// Number of drawn sprites. An emitter on the GPU counts with its capacity, because the number of its
    /// living particles is not read back.
    uint64_t sprites;

    /// Number of drawn meshes. An emitter on the GPU counts with its capacity.
    uint64_t meshes;

    /// Number of drawn pieces of ribbons. A piece connects two points. An emitter on the GPU counts with its
    /// capacity.
    uint64_t ribbonPieces;

    /// Length of all particle lists of FX_COMPOSITION_SLABS: one list for each tile of 16 x 16 pixels at
    /// layerScale. A particle of media counts once for each tile that it covers. Counted only with
    /// countOverdraw.
    uint64_t listedBlobs;

    /// Number of particles of media that are missing from the lists of listedBlobs because the lists were
    /// full. The listed particles are weighted so that the mean density of the picture stays the same. The
    /// picture has less detail.
    uint64_t spilledBlobs;

    /// Number of fragments of sprites, meshes, ribbons and impostors that were omitted because the lists were
    /// full.
    uint64_t spilledFragments;

    /// The composition with which the frame was drawn (FX_COMPOSITION_...). FX_COMPOSITION_AUTOMATIC and the
    /// frame budget may choose another composition than the setting.
    uint32_t composition;

    /// Number of slabs along a ray, or of voxels along 16 particle radii, with which the frame was drawn; 0
    /// with FX_COMPOSITION_SORTED.
    uint32_t compositionSize;

    /// Number of block types of the visible effects. Each phase of an animated type that is in use counts.
    uint32_t blocks;

    /// Number of blocks of the visible effects, at all levels of their hierarchies.
    uint32_t blockInstances;

    /// Number of particles of media that these blocks consist of.
    uint64_t blockParticles;

    /// Number of particles of blocks beyond the member "maxParticles" of their effects. They are not drawn,
    /// unless their blocks are drawn as impostors.
    uint64_t blockParticlesRefused;

    /// Number of blocks that were drawn as impostors.
    uint32_t blockImpostors;

    /// Number of tiles of impostors that were drawn in the frame. Later frames reuse them.
    uint32_t blockTilesDrawn;
} FxViewStatistics;

#ifdef __cplusplus
}
#endif

#endif
