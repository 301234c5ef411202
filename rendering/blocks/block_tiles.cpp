#include "rendering/blocks/block_tiles.h"

#include "foundation/math/hash.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace fx::render {

namespace {

constexpr uint32_t kSlotsOfPage = (kMaxTile / kMinTile) * (kMaxTile / kMinTile); ///< of the smallest size
constexpr uint32_t kMaxPages = kTilePageColumns * kMaxTilePageRows;
/// Balls times 8 x 8 texels that the jobs of a frame may have beyond the tiles that neither others nor balls
/// can replace.
constexpr uint64_t kWorkOfFrame = uint64_t(1) << 22;
/// [1] Tiles become finer again where there is room for so many times the blocks, so that they do not become
/// finer and coarser in turn.
constexpr float kRoomAgain = 1.25f;

/// At least 4: kMaxNearness is one of them, and a tile of an eye in the block has no size.
constexpr int kMinNearnessSteps = 4, kMaxNearnessSteps = 4096;
constexpr double kMaxTileSeconds = 0.1; ///< [s] of animated content: sizes, opacities and colors change too
constexpr double kMostDeferred = 4.0;   ///< [1] factor of the limits of a tile that is replaced later

/// A tile for another distance is wrong by up to the difference of nearness [rad] at the rim.
int nearnessSteps(float angle)
{
    const float steps = 0.5f / std::max(angle, 0.5f / float(kMaxNearnessSteps));
    return std::clamp(int(std::bit_ceil(uint32_t(std::ceil(steps)))), kMinNearnessSteps, kMaxNearnessSteps);
}

int16_t densityClass(float density)
{
    return int16_t(std::lround(2.0f * std::clamp(std::log2(std::max(density, 1e-6f)), -16.0f, 16.0f)));
}

/// `value` times 2^power, at least 1.
uint16_t scaledBy(int power, uint16_t value)
{
    return uint16_t(power < 0 ? std::max(value / 2, 1) : value << power);
}

uint32_t slotsAlong(int size)
{
    return uint32_t(kMaxTile / size);
}

} // namespace

size_t BlockTiles::KeyHash::operator()(const Key& key) const
{
    const uint64_t place = base::hashWord(key.identity, uint64_t(uint32_t(key.cell)));
    return size_t(base::hashWord(place, uint64_t(key.cells) << 16 | key.size | uint64_t(key.nearness) << 32 |
                                            uint64_t(uint16_t(key.density)) << 48));
}

void BlockTiles::begin(const TileSettings& settings)
{
    settings_ = settings;
    jobs_.clear();
    ++frame_;
    work_ = 0;
    deferred_ = 0;
    blocks_ = 0;
}

void BlockTiles::forget()
{
    found_.clear();
    slots_.clear();
    pages_.clear();
    jobs_.clear();
    classes_ = {};
    deferred_ = 0;
}

bool BlockTiles::chooseFinest()
{
    const auto fits = [&](int size, float blocks) {
        return blocks * float(size) * float(size) <= float(kMaxPages) * float(kMaxTile) * float(kMaxTile);
    };
    const int before = finest_;
    const float more = settings_.isSpread ? kRoomAgain : 1.0f;
    while (finest_ > kMinTile && !fits(finest_, float(blocks_)))
        finest_ /= 2;
    while (finest_ < kMaxTile && fits(2 * finest_, more * float(blocks_)))
        finest_ *= 2;
    return finest_ != before;
}

int BlockTiles::pageRows() const
{
    const size_t rows = (pages_.size() + kTilePageColumns - 1) / kTilePageColumns;
    return rows == 0 ? 0 : int(std::bit_ceil(rows));
}

std::optional<Tile> BlockTiles::find(const TileRequest& request)
{
    const BlockContent& content = *request.content;
    if (!hasTiles(content))
        return std::nullopt;
    const float pixels = std::clamp(request.pixels, 1.0f, 4.0f * float(kMaxTile));
    const float radius = 0.5f * pixels;
    const float angle = std::min(settings_.parallax / radius, request.angle);
    const int cells = cellsForAngle(request.along, angle);
    const int size = std::clamp(int(std::bit_ceil(uint32_t(std::ceil(settings_.resolution * pixels)))),
                                std::clamp(request.texels, kMinTile, kMaxTile), kMaxTile);
    const glm::ivec2 cell = directionCell(request.along, cells);
    const int steps = nearnessSteps(angle);
    const float nearness = std::clamp(request.nearness, 0.0f, kMaxNearness);
    const Key key{content.identity,
                  cell.y * cells + cell.x,
                  uint16_t(cells),
                  uint16_t(size),
                  uint16_t(std::lround(nearness * float(steps))),
                  uint16_t(steps),
                  content.isColored ? densityClass(request.density) : int16_t(0)};
    const auto same = found_.find(key);
    if (same != found_.end() && isFresh(slots_[same->second], request))
        return use(same->second);
    if (settings_.isSpread && work_ > kWorkOfFrame) {
        const auto other =
            same != found_.end() ? std::optional(same->second) : neighbor(request, key, cell, false);
        if (other && canWait(slots_[*other], request)) {
            ++deferred_;
            return use(*other);
        }
        if (request.isOptional) {
            ++deferred_;
            return std::nullopt;
        }
    }
    const auto slot = same != found_.end() ? std::optional(same->second) : slotFor(key);
    if (!slot) {
        const auto other = neighbor(request, key, cell, true);
        return other && canWait(slots_[*other], request) ? std::optional(use(*other)) : std::nullopt;
    }
    make(*slot, request);
    return use(*slot);
}

namespace {

/// [pixel] By how much animated content has moved in `seconds`.
double movedBy(double seconds, const TileRequest& request)
{
    const BlockContent& content = *request.content;
    return std::abs(seconds) * double(content.speed) * 0.5 * double(request.pixels) /
           std::max(double(content.radius), 1e-12);
}

} // namespace

/// True if the content has changed by no more than the settings allow since the tile was made.
bool BlockTiles::isFresh(const Slot& slot, const TileRequest& request) const
{
    const double seconds = request.seconds - slot.seconds;
    if (!request.content->isAnimated || seconds == 0.0)
        return true;
    return movedBy(seconds, request) <= double(settings_.parallax) && std::abs(seconds) <= kMaxTileSeconds;
}

/// True if a tile may be shown although it is due.
bool BlockTiles::canWait(const Slot& slot, const TileRequest& request) const
{
    const double seconds = request.content->isAnimated ? request.seconds - slot.seconds : 0.0;
    return movedBy(seconds, request) <= kMostDeferred * double(settings_.parallax) &&
           std::abs(seconds) <= kMostDeferred * kMaxTileSeconds;
}

/// The existing tile that differs least.
/// @param isAnyFineness true: also of another distance or fineness, which is seen when it is replaced
std::optional<uint32_t> BlockTiles::neighbor(const TileRequest& request, const Key& key,
                                             const glm::ivec2& cell, bool isAnyFineness) const
{
    std::optional<uint32_t> best;
    float least = 2.0f;
    const float nearness = std::clamp(request.nearness, 0.0f, kMaxNearness);
    const auto consider = [&](Key other, const glm::ivec2& at) {
        other.cell = at.y * other.cells + at.x;
        const auto same = found_.find(other);
        if (same == found_.end())
            return;
        const glm::vec3 between = axesOfCell(at, other.cells).along - request.along;
        const float farther = float(other.nearness) / float(other.nearnessSteps) - nearness;
        const float away =
            between.x * between.x + between.y * between.y + between.z * between.z + farther * farther;
        if (away < least) {
            least = away;
            best = same->second;
        }
    };
    for (int i = 0; i < 9; ++i)
        consider(key, neighborCell(cell, {i % 3 - 1, i / 3 - 1}, key.cells));
    for (int i = 0; isAnyFineness && i < 27; ++i) { // half, as many and twice the cells, steps and texels
        Key other = key;
        other.cells = scaledBy(i % 3 - 1, key.cells);
        other.nearnessSteps = scaledBy(i / 3 % 3 - 1, key.nearnessSteps);
        other.size = scaledBy(i / 9 - 1, key.size);
        other.nearness = uint16_t(std::lround(nearness * float(other.nearnessSteps)));
        consider(other, directionCell(request.along, other.cells));
    }
    return best;
}

std::optional<uint32_t> BlockTiles::slotFor(const Key& key)
{
    const auto slot = freeSlot(key.size);
    if (!slot)
        return std::nullopt;
    Slot& taken = slots_[*slot];
    if (taken.isTaken)
        found_.erase(taken.key);
    taken = {key, 0.0, 0.0f, frame_, true};
    found_[key] = *slot;
    return slot;
}

BlockTiles::SizeClass& BlockTiles::classOf(int size)
{
    return classes_[size_t(std::countr_zero(uint32_t(size)) - std::countr_zero(uint32_t(kMinTile)))];
}

/// A slot that has no tile, or one that this frame does not use.
std::optional<uint32_t> BlockTiles::freeSlot(int size)
{
    SizeClass& all = classOf(size);
    if (all.taken < all.slots.size() || takePage(size))
        return all.slots[all.taken++];
    for (size_t i = 0; i < all.slots.size() && all.full != frame_; ++i) {
        const uint32_t slot = all.slots[all.hand++ % all.slots.size()];
        if (slots_[slot].frame < frame_)
            return slot;
    }
    all.full = frame_;
    return std::nullopt;
}

/// Adds a page to the tiles of a size: a new one, or the one of another size that was not used for longest.
bool BlockTiles::takePage(int size)
{
    auto page = uint32_t(pages_.size());
    if (page < kMaxPages) {
        pages_.push_back({});
        slots_.resize(pages_.size() * kSlotsOfPage);
    } else {
        const auto oldest = std::ranges::min_element(pages_, {}, &Page::frame);
        if (oldest->frame >= frame_ || oldest->size == size)
            return false;
        page = uint32_t(oldest - pages_.begin());
        clearPage(page);
    }
    pages_[page] = {size, frame_};
    for (uint32_t i = 0; i < slotsAlong(size) * slotsAlong(size); ++i)
        classOf(size).slots.push_back(page * kSlotsOfPage + i);
    return true;
}

void BlockTiles::clearPage(uint32_t page)
{
    SizeClass& all = classOf(pages_[page].size);
    for (const uint32_t slot : all.slots)
        if (slot / kSlotsOfPage == page && slots_[slot].isTaken) {
            found_.erase(slots_[slot].key);
            --all.taken;
        }
    std::erase_if(all.slots, [&](uint32_t slot) { return slot / kSlotsOfPage == page; });
    std::fill_n(slots_.begin() + ptrdiff_t(page * kSlotsOfPage), kSlotsOfPage, Slot());
}

Tile BlockTiles::use(uint32_t slot)
{
    Slot& used = slots_[slot];
    const uint32_t page = slot / kSlotsOfPage, place = slot % kSlotsOfPage;
    used.frame = pages_[page].frame = frame_;
    const int size = used.key.size;
    const uint32_t along = slotsAlong(size);
    const glm::ivec2 corner = kMaxTile * glm::ivec2(page % kTilePageColumns, page / kTilePageColumns) +
                              size * glm::ivec2(place % along, place / along);
    const int cells = used.key.cells;
    return {corner, size, axesOfCell({used.key.cell % cells, used.key.cell / cells}, cells),
            float(used.key.nearness) / float(used.key.nearnessSteps), used.brightest};
}

void BlockTiles::make(uint32_t slot, const TileRequest& request)
{
    const Tile tile = use(slot);
    const glm::vec3& light = request.content->brightest;
    slots_[slot].seconds = request.seconds;
    slots_[slot].brightest = std::max({light.x, light.y, light.z});
    jobs_.push_back({request.variant, tile.corner, tile.size, tile.axes, request.content->radius,
                     tile.nearness, std::exp2(0.5f * float(slots_[slot].key.density))});
    work_ += uint64_t(request.content->balls) * uint64_t(tile.size / 8) * uint64_t(tile.size / 8);
}

} // namespace fx::render
