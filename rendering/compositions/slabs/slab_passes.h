/// @file slab_passes.h
/// The passes that sum media in slabs, the depth intervals of each ray.
#pragma once

#include "rendering/compositions/slabs/slab_tiles.h"
#include "rendering/field/field_blocks.h"
#include "rendering/passes/blob_light_pass.h"
#include "rendering/passes/media_pass.h"

namespace fx::render {

/// Kind of detail (procedural noise) that is drawn.
enum class SlabDetail : uint8_t
{
    None,
    OfBalls,  ///< noise of single balls
    OfFields, ///< noise of single balls, and detail of fields of balls
};

constexpr size_t kSlabPrograms = 2 * 2 * 2 * 3 * 2;
/// Returns the program that sums media in slabs.
/// @param slabs 6 or 16
/// @param network true: some balls are in illumination networks
/// @param blocks true: some balls have tiles
const ProgramDesc& slabProgram(int slabs, SlabDetail detail, bool layers, bool network = false,
                               bool blocks = false);
const ProgramDesc& slabProgramAt(size_t index);

inline constexpr ProgramDesc kSlabCardsProgram{"slab cards", nullptr, nullptr, "slabs/slab_cards.comp.glsl",
                                               nullptr};
/// Returns the program of SlabBallPass.
/// @param detail true: the program evaluates the detail of fields
/// @param blocks true: some balls have tiles
const ProgramDesc& slabBallsProgram(bool detail, bool blocks = false);
inline constexpr ProgramDesc kSlabTilesProgram{"slab tiles", nullptr, nullptr, "slabs/slab_tiles.comp.glsl",
                                               nullptr};

/// Largest total number of entries in the lists of balls of a frame. An entry has 4 bytes.
constexpr uint64_t kMaxListedBalls = uint64_t(1) << 23;
/// Largest number of fragments of cards in a frame. A fragment has 32 bytes.
constexpr uint64_t kMaxCards = uint64_t(1) << 21;

/// Collects the fragments of cards in one linked list per texel. The result does not depend on the drawing
/// order.
///
/// reads   the buffers of the sources
///         distance  [m] along the ray to opaque geometry
/// writes  lists of card fragments, and flags of tiles with cards
class SlabCardPass
{
public:
    struct Inputs
    {
        /// batches of sources without balls; batches and sources must stay valid
        std::span<const DrawBatch> batches;
        const MediaPass::Inputs* media; ///< inputs of the composition
        uint64_t capacity;  ///< largest number of fragments; further fragments are dropped and counted
        bool marks = false; ///< true: also collect the data for ViewSettings::outputs
    };
    [[nodiscard]] static CardLists addTo(FrameGraph& graph, const Inputs& in);
};

/// Detail of the fields to which balls belong. The data of both spans must stay valid until the graph has
/// executed.
struct BallDetails
{
    std::span<const BlobMaterial> materials{}; ///< one material per ball; empty: no field has detail
    std::span<const FieldDetailBlock> details{};
    ResourceId lumpTile{}; ///< texture of LumpTileTexture
};

/// Uploads the parameters of the detail of fields as texels, and the noise coordinates of each ball.
///
/// writes  texels     RGBA32F of kFieldColumns, layout of shaders/field/field_detail.glsl
///         materials  buffer of BlobMaterial
class SlabDetailPass
{
public:
    struct Outputs
    {
        ResourceId texels, materials, lumpTile; ///< invalid if no field has detail
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const BallDetails& in);
};

/// Writes balls and the light that they scatter as texels.
///
/// reads   list     balls, and their light from BlobLightPass
///         detail   detail of the fields that the balls belong to
/// writes  texture  RGBA32F, layout of shaders/slabs/slab_balls.glsl; invalid without balls
class SlabBallPass
{
public:
    /// @param readsTiles true: balls with tiles are written as such; false: as balls of the kernel
    [[nodiscard]] static ResourceId addTo(FrameGraph& graph, const BallList& list,
                                          const SlabDetailPass::Outputs& detail, const ViewBlock& view,
                                          bool readsTiles = false);
};

/// Largest number of iterations of all loops of an invocation together. Mesa's software renderers end all
/// loops of an invocation after 65,535 iterations; the difference is for the loops over cards.
constexpr uint32_t kMaxLoopTurns = 60000;

/// Lists the balls of each tile of 16 x 16 texels, in the order of balls, and the tiles that are not empty.
/// If a tile has more than n - 4 sqrt(n) balls for `maxOfTile` = n, it lists that many with the lowest ranks,
/// which represent all. The last fifth of the listed ranks have weights that fall to 0, so that balls enter
/// and leave the list smoothly.
///
/// reads   rects  which tiles each ball may cover
///         cards, fieldTiles
/// writes  tiles  arguments of a draw of one square per tile, counters, and the range of each tile in `lists`
///         lists  R32UI entries, see listEntry in shaders/slabs/slab_balls.glsl
class SlabTilePass
{
public:
    struct Inputs
    {
        /// Tiles that each ball may cover; must stay valid until the graph has executed.
        std::span<const TileRect> rects;
        uint64_t entries;   ///< total number of tiles in all `rects`
        int width, height;  ///< [texel]
        uint32_t maxOfTile; ///< largest number of balls in the list of a tile, >= 2
        float flip;         ///< 1: window y and clip-space y have equal directions; -1: opposite directions
        CardLists cards;
        ResourceId fieldTiles = {}; ///< buffer of FieldTileBlock; tiles with fields count as not empty
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

/// Sums all media of a texel in slabs along its ray, and composites the slabs front to back. Formulas:
/// kernel-quantile, kernel-moment, slab-light.
///
/// reads   the results of SlabBallPass, SlabTilePass and SlabCardPass
///         distance  [m] along the ray to opaque geometry
///         networks  illumination networks
/// writes  media     targets of MediaPass, drawn over `under`
/// No work is done for tiles without balls and cards. The pass keeps no state between frames.
class SlabPass
{
public:
    struct Inputs
    {
        const MediaPass::Inputs* media;
        ResourceId balls; ///< invalid without balls
        SlabDetail detail;
        SlabDetailPass::Outputs fieldDetail;
        SlabTilePass::Outputs tiles;
        CardLists cards;
        BlockTileBindings blocks; ///< tiles of balls; invalid: no ball has a tile
        int slabs;                ///< number of slabs: 6 or 16
        /// Invalid moments: none. Otherwise lights of balls are those of networks, see BlobLightPass, and
        /// that of balls with tiles is looked up along rays.
        BlobLightPass::Networks networks = {};
    };
    /// Returns the largest SlabTilePass::Inputs::maxOfTile with which the loops over the balls of a tile and
    /// over their fields take at most kMaxLoopTurns iterations.
    /// @param fields number of fields with detail; counted up to an eighth of the iterations
    /// @param blocks true: some balls have tiles
    /// @param isCut true: the call draws a range of depth
    static uint32_t maxOfTile(int slabs, SlabDetail detail, bool layers, size_t fields, bool blocks = false,
                              bool isCut = false);
    [[nodiscard]] static MediaPass::Outputs addTo(FrameGraph& graph, const Inputs& in,
                                                  const MediaPass::Outputs& under);
};

} // namespace fx::render
