/// @file block_tiles.h
/// The cache of tiles: pictures of the optical depth of blocks, each from one direction, in an atlas.
#pragma once

#include "rendering/blocks/block_contents.h"
#include "rendering/blocks/block_directions.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace fx::render {

/// [texel] Sides of tiles are powers of 2 from kMinTile to kMaxTile.
constexpr int kMinTile = 16;
constexpr int kMaxTile = 128;
constexpr size_t kTileSizes = 4;
constexpr float kMaxNearness = 0.75f; ///< [1] radius over distance; impostors are not nearer than 1.5 radii
constexpr int kTilePageColumns = 16;  ///< pages of kMaxTile^2 texels side by side in the atlas
constexpr int kMaxTilePageRows = 8;   ///< 2048 x 1024 texels
/// Content with more balls gets no tiles: software renderers end loops after 65,535 turns. Content of several
/// colors is passed through twice.
constexpr uint32_t kMaxTileBalls = 61440;
constexpr bool hasTiles(const BlockContent& content)
{
    return content.balls > 0 && content.balls <= (content.isColored ? kMaxTileBalls / 2 : kMaxTileBalls);
}

/// A tile that is to be drawn in this frame.
struct TileJob
{
    uint32_t variant = 0;
    glm::ivec2 corner{0}; ///< [texel] in the atlas
    int size = 0;         ///< [texel]
    TileAxes axes;
    float radius = 0.0f;   ///< [m] of the block, in its units
    float nearness = 0.0f; ///< [1] radius over the distance of the eye; 0: rays are parallel
    float density = 1.0f;  ///< [1] factor of the depth of colored content, for what hides what is behind it
};

/// A tile as it is drawn.
struct Tile
{
    glm::ivec2 corner{0};
    int size = 0;
    TileAxes axes;
    float nearness = 0.0f;  ///< [1] radius of the block over the distance of the tile's eye
    float brightest = 0.0f; ///< [cd/m2] light for which the tile has the value 1
};

/// What a tile has to show.
struct TileRequest
{
    uint32_t variant = 0;
    const BlockContent* content = nullptr;
    glm::vec3 along{0.0f};   ///< unit vector from the eye to the block, in the space of the block
    float pixels = 0.0f;     ///< [pixel] diameter of the block on the picture
    double seconds = 0.0;    ///< local time of animated content
    float nearness = 0.0f;   ///< [1] radius of the block over its distance; 0: orthographic
    float density = 1.0f;    ///< [1] factor of its optical depth
    float angle = 1e9f;      ///< [rad] largest difference of directions, if smaller than that of the settings
    int texels = 0;          ///< least side of the tile
    bool isOptional = false; ///< true: the content can be drawn instead
};

/// Limits of the error of a tile.
struct TileSettings
{
    float parallax = 0.5f;   ///< [pixel] largest shift of the front of a block against its middle
    float resolution = 1.0f; ///< texels per pixel, at least
    bool isSpread = true;    ///< false: all tiles are drawn at once when they are needed

    bool operator==(const TileSettings&) const = default;
};

/// Tiles of one view. The memory of the atlas belongs to the caller.
class BlockTiles
{
public:
    explicit BlockTiles(std::pmr::memory_resource* memory) : slots_(memory), pages_(memory), jobs_(memory) {}

    void begin(const TileSettings& settings);
    /// The tile that shows the content best. Tiles that do not exist yet are made in this frame, see jobs();
    /// if a tile of a neighboring direction exists and many tiles are to be made, that one is given instead.
    /// Where there is no room, a tile of another distance or fineness may be given.
    /// @return no value if there is no room, the content has too many balls, or many tiles are to be made and
    /// this one is optional
    std::optional<Tile> find(const TileRequest& request);

    /// Counts a block whose error is limited.
    void countBlock() { ++blocks_; }
    /// [texel] Largest side of tiles that are finer than the picture because of their error, at which the
    /// atlas has room for one tile of each block that was counted.
    int finest() const { return finest_; }
    /// Chooses finest() by the blocks that were counted since begin(), for what is found from now on.
    /// @return true if it has changed
    bool chooseFinest();

    std::span<const TileJob> jobs() const { return jobs_; }
    uint32_t deferred() const
    {
        return deferred_;
    }                     ///< tiles that are replaced by others, or left out, in this frame
    int pageRows() const; ///< rows of pages that tiles need, a power of 2; 0: none
    void forget();        ///< discards all tiles

private:
    struct Key
    {
        uint64_t identity = 0;
        int32_t cell = 0; ///< number of the cell
        uint16_t cells = 0, size = 0;
        uint16_t nearness = 0; ///< number of steps of 1 / nearnessSteps
        uint16_t nearnessSteps = 1;
        int16_t density = 0; ///< half of the binary logarithm; 0 where balls have one color
        bool operator==(const Key&) const = default;
    };
    struct KeyHash
    {
        size_t operator()(const Key& key) const;
    };
    struct Slot
    {
        Key key;
        double seconds = 0.0; ///< local time of the content
        float brightest = 0.0f;
        uint64_t frame = 0; ///< in which the slot was last used
        bool isTaken = false;
    };
    /// A square of kMaxTile^2 texels with tiles of one size.
    struct Page
    {
        int size = 0;       ///< 0: free
        uint64_t frame = 0; ///< in which a slot was last used
    };

    /// Slots of all pages of one size. Slots that have no tile yet are the last ones.
    struct SizeClass
    {
        std::vector<uint32_t> slots;
        size_t taken = 0;  ///< number of slots with a tile
        size_t hand = 0;   ///< where the search for a slot that can be replaced goes on
        uint64_t full = 0; ///< frame in which no slot can be replaced any more
    };

    SizeClass& classOf(int size);
    std::optional<uint32_t> slotFor(const Key& key);
    std::optional<uint32_t> freeSlot(int size);
    bool takePage(int size);
    void clearPage(uint32_t page);
    std::optional<uint32_t> neighbor(const TileRequest& request, const Key& key, const glm::ivec2& cell,
                                     bool isAnyFineness) const;
    bool isFresh(const Slot& slot, const TileRequest& request) const;
    bool canWait(const Slot& slot, const TileRequest& request) const;
    Tile use(uint32_t slot);
    void make(uint32_t slot, const TileRequest& request);

    TileSettings settings_;
    std::unordered_map<Key, uint32_t, KeyHash> found_;
    std::pmr::vector<Slot> slots_; ///< kSlotsOfPage for each page
    std::pmr::vector<Page> pages_;
    std::pmr::vector<TileJob> jobs_;
    std::array<SizeClass, kTileSizes> classes_;
    uint64_t frame_ = 0;
    uint64_t work_ = 0; ///< of the jobs of this frame
    uint32_t deferred_ = 0;
    uint32_t blocks_ = 0; ///< that were counted in this frame
    int finest_ = kMaxTile;
};

} // namespace fx::render
