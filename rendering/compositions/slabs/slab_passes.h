/// @file slab_passes.h
/// The passes that put media together in slabs across each ray.
#pragma once

#include "rendering/compositions/slabs/slab_tiles.h"
#include "rendering/field/field_blocks.h"
#include "rendering/passes/media_pass.h"

namespace fx::render {

/// Detail that slabs draw.
enum class SlabDetail : uint8_t
{
    None,
    OfBalls,  ///< noise of each ball by itself
    OfFields, ///< and of fields
};

constexpr size_t kSlabPrograms = 2 * 3 * 2;
/// @param slabs 6 or 16
const ProgramDesc& slabProgram(int slabs, SlabDetail detail, bool layers);
const ProgramDesc& slabProgramAt(size_t index);

inline constexpr ProgramDesc kSlabCardsProgram{"slab cards", nullptr, nullptr, "slabs/slab_cards.comp.glsl",
                                               nullptr};
/// @param detail of fields
const ProgramDesc& slabBallsProgram(bool detail);
inline constexpr ProgramDesc kSlabTilesProgram{"slab tiles", nullptr, nullptr, "slabs/slab_tiles.comp.glsl",
                                               nullptr};

constexpr uint64_t kMaxListedBalls = uint64_t(1) << 23; ///< entries of all lists of a frame, of 4 bytes
constexpr uint64_t kMaxCards = uint64_t(1) << 21;       ///< fragments of cards of a frame, of 32 bytes

/// Gathers the fragments of cards, in one list a texel. The result does not depend on the drawing order.
///
/// reads the buffers of the sources
///         distance  [m] along the ray to opaque geometry
/// writes cards lists, and flags of tiles with cards
class SlabCardPass
{
public:
    struct Inputs
    {
        std::span<const DrawBatch> batches; ///< of sources without balls; must stay, as must their sources
        const MediaPass::Inputs* media;     ///< of the composition
        uint64_t capacity;                  ///< fragments; more are left out and counted
        bool marks = false;                 ///< besides, what outputs need
    };
    [[nodiscard]] static CardLists addTo(FrameGraph& graph, const Inputs& in);
};

/// Detail of the fields that balls belong to; both lists must stay until the graph has executed.
struct BallDetails
{
    std::span<const BlobMaterial> materials{}; ///< one a ball; empty: no field has detail
    std::span<const FieldDetailBlock> details{};
    ResourceId lumpTile{}; ///< of LumpTileTexture
};

/// Details of fields as texels, and what balls have of them.
///
/// writes  texels     RGBA32F of kFieldColumns, layout of shaders/field/field_detail.glsl
///         materials  buffer of BlobMaterial
class SlabDetailPass
{
public:
    struct Outputs
    {
        ResourceId texels, materials, lumpTile; ///< invalid: no field has detail
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const BallDetails& in);
};

/// Balls and their lights as texels.
///
/// reads   list     balls, and what BlobLightPass has written for them
///         detail   of the fields that they belong to
/// writes  texture  RGBA32F, layout of shaders/slabs/slab_balls.glsl; invalid without balls
class SlabBallPass
{
public:
    [[nodiscard]] static ResourceId addTo(FrameGraph& graph, const BallList& list,
                                          const SlabDetailPass::Outputs& detail, const ViewBlock& view);
};

/// Turns of loops that a program may take in one invocation. Mesa's software renderers end all loops after
/// 65,535.
constexpr uint32_t kMaxLoopTurns = 60000;

/// Lists the balls of each tile of 16 x 16 texels, in their order, and the tiles that show something.
/// A tile with more than `maxOfTile` lists those with the lowest ranks, of which each stands for
/// (balls of the tile) / (entries) of them.
///
/// reads   rects  which tiles each ball may cover
///         cards, fieldTiles
/// writes  tiles  arguments of a draw of one square a tile, counters, and each tile's part of the lists
///         lists  R32UI numbers of balls
class SlabTilePass
{
public:
    struct Inputs
    {
        std::span<const TileRect> rects; ///< must stay until the graph has executed
        uint64_t entries;                ///< tiles of all of them
        int width, height;               ///< [texel]
        uint32_t maxOfTile;              ///< entries, >= 2
        float flip;                      ///< of window y against clip y, 1 or -1
        CardLists cards;
        ResourceId fieldTiles = {}; ///< buffer of FieldTileBlock: their tiles show something as well
    };
    struct Outputs
    {
        ResourceId tiles, lists;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// Counters of SlabTilePass, at the beginning of `tiles`.
struct SlabTileCounts
{
    uint32_t vertices, tiles, reserved[2];
    uint32_t listed, spilled, unused[2];
};
static_assert(sizeof(SlabTileCounts) == 32);

/// Sums all media of a texel in slabs across its ray, and composites the slabs front to back. Formulas:
/// kernel-quantile, kernel-moment, slab-light.
///
/// reads   what SlabBallPass, SlabTilePass and SlabCardPass have written
///         distance  [m] along the ray to opaque geometry
/// writes  media     as the media pass, drawn over `under`
/// Tiles without balls and cards cost nothing. Keeps no state.
class SlabPass
{
public:
    struct Inputs
    {
        const MediaPass::Inputs* media;
        ResourceId balls; ///< invalid without any
        SlabDetail detail;
        SlabDetailPass::Outputs fieldDetail;
        SlabTilePass::Outputs tiles;
        CardLists cards;
        int slabs; ///< 6 or 16
    };
    /// Entries of a tile that its programs read within kMaxLoopTurns.
    static constexpr uint32_t maxOfTile(int slabs) { return kMaxLoopTurns / (slabs > 6 ? 28 : 14); }
    [[nodiscard]] static MediaPass::Outputs addTo(FrameGraph& graph, const Inputs& in,
                                                  const MediaPass::Outputs& under);
};

} // namespace fx::render
