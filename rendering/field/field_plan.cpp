#include "rendering/field/field_plan.h"

#include "foundation/assets/volume_levels.h"
#include "foundation/memory/amortized_vector.h"
#include "foundation/snapshot/volume_kind.h"
#include "rendering/frame/ball_window.h"
#include "rendering/frame/view_volume.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::render {

namespace {

constexpr float kPixelsPerVoxel = 1.0f; ///< finer voxels would not be seen
constexpr float kRadii = 16.0f;         ///< of balls along which there are as many voxels as asked for
constexpr int kMinVoxels = 16, kMaxVoxels = 256; ///< along those
constexpr float kLooseShare = 0.4f;              ///< of an effect's radius: what is smaller stays a ball
constexpr float kLooseVoxels = 0.5f;   ///< likewise, of a voxel: it would be spread over 64 times its volume
constexpr float kLooseFire = 1.5f;     ///< likewise, of fire: a spark is far brighter than what is around it
constexpr int kMaxBricksPerAxis = 128; ///< of a field, along an axis
constexpr int64_t kMaxBoxBricks = 1 << 16; ///< of a field, with the empty ones
constexpr int kMaxTries = 64;              ///< to keep the budget of bricks
constexpr int kSmoothFirst = 8;            ///< of them, in which fields with detail stay as fine
constexpr float kMinVoxel = 1e-4f;         ///< [m]
constexpr float kTouch = 1.0001f;          ///< radii are compared with a margin, for what the GPU rounds
constexpr float kWithinBrick = 0.1f;       ///< [voxel] from the middle of a brick
constexpr float kCoarseReach = 1.5f;       ///< [voxel] that coarser voxels reach beyond finer ones
/// Of all fields: as many as textures of the sides that GL guarantees hold, and fewer than 2^16, up to which
/// the table of floats holds numbers with their bits.
constexpr uint32_t kMostBricks = 2048 / kBrickSamples * kBrickColumns * kBrickColumns;
static_assert(kMostBricks < (1u << 16));
constexpr uint32_t kUnseen = ~0u; ///< entry of the table: medium that no ray meets

const float kStep = std::exp2(0.25f); ///< between the sides of voxels

/// The nearest power of kStep.
float quantized(float side)
{
    return std::exp2(std::round(4.0f * std::log2(side)) * 0.25f);
}

float brickReach(float voxel)
{
    return 0.5f * std::sqrt(3.0f) * float(kBrickCells) * voxel;
}

float distanceToBox(const glm::vec3& low, const glm::vec3& high)
{
    return glm::length(glm::max(glm::max(low, -high), glm::vec3(0.0f)));
}

/// The bricks that a ball may touch, in bricks of its field.
struct BrickRange
{
    glm::ivec3 first, last;
    glm::vec3 center; ///< in bricks
    float radius;     ///< in bricks

    /// @param reach [m] radius of the ball with its margin
    BrickRange(const FieldBlock& field, const BlobInstance& ball, float reach)
    {
        const float side = field.corner.w * float(kBrickCells);
        center = (glm::vec3(ball.centerRadius) - glm::vec3(field.corner)) / side;
        radius = reach / side;
        const glm::ivec3 end = glm::ivec3(field.bricks) - 1;
        first = glm::clamp(glm::ivec3(glm::floor(center - radius)), glm::ivec3(0), end);
        last = glm::clamp(glm::ivec3(glm::floor(center + radius)), glm::ivec3(0), end);
    }

    bool touches(const glm::ivec3& brick) const
    {
        const glm::vec3 low(brick);
        const glm::vec3 d = center - glm::clamp(center, low, low + 1.0f);
        return glm::dot(d, d) < radius * radius;
    }

    /// Calls `visit(index)` with the entry of the table of each brick that the ball touches.
    template <class Visit>
    void forEach(const FieldBlock& field, Visit&& visit) const
    {
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x)
                    if (touches({x, y, z}))
                        visit(size_t(field.bricks.w + x + field.bricks.x * (y + field.bricks.y * z)));
    }
};

} // namespace

FieldPlan::FieldPlan(std::pmr::memory_resource* memory)
    : lattices_(memory), fields_(memory), bricks_(memory), table_(memory), balls_(memory), loose_(memory),
      volumes_(memory), peaks_(memory), emitted_(memory), media_(memory), glow_(memory), near_(memory),
      stamps_(memory), seen_(memory), tiles_(memory), tileFields_(memory)
{}

void FieldPlan::clear()
{
    lattices_.clear();
    fields_.clear();
    bricks_.clear();
    table_.clear();
    balls_.clear();
    loose_.clear();
    volumes_.clear();
    tiles_.clear();
    tileFields_.clear();
    glow_.clear();
    near_.clear();
    hasNetworks_ = false;
    lacksLevels_ = false;
}

bool FieldPlan::build(const FieldPlanInputs& in)
{
    clear();
    if (in.balls.empty()) {
        glow_.forget();
        return true;
    }
    chooseVoxels(in);
    const auto isDetailed = [](const BlobEffect& effect) { return effect.detail >= 0; };
    const bool isMixed =
        std::ranges::any_of(in.effects, isDetailed) && !std::ranges::all_of(in.effects, isDetailed);
    for (int i = 0; i < kMaxTries && !place(in); ++i)
        enlargeVoxels(in, isMixed && i < kSmoothFirst);
    if (lacksLevels_) {
        clear();
        return false;
    }
    listBricks();
    listVolumes(in);
    listBalls(in);
    listNear(in);
    listTiles(in);
    if (in.glows)
        buildGlow(in);
    return true;
}

void FieldPlan::buildGlow(const FieldPlanInputs& in)
{
    const float perSlope = 0.5f * float(in.height) * std::abs(in.camera->clipScale.y); // [pixel]
    const FieldGlowPlan::Choice choice{media_, perSlope, in.camera->orthographic};
    glow_.build(fields_, emitted_, in.camera->eye, in.networkCells, media_.empty() ? nullptr : &choice);
    hasNetworks_ = in.networkCells > 0 && !glow_.grids().empty();
    if (in.networkCells > 0 && !hasNetworks_)
        glow_.build(fields_, emitted_, in.camera->eye);
}

/// Smooth fields lose less by it than those with detail, whose thresholds depend on extinctions.
void FieldPlan::enlargeVoxels(const FieldPlanInputs& in, bool smoothOnly)
{
    for (size_t i = 0; i < lattices_.size(); ++i)
        if ((in.effects[i].volume < 0 ? isOverBalls_ : isOverVolumes_) &&
            (!smoothOnly || in.effects[i].detail < 0))
            enlarge(lattices_[i], in.effects[i], in);
}

void FieldPlan::enlarge(Lattice& lattice, const BlobEffect& effect, const FieldPlanInputs& in)
{
    if (effect.volume < 0) {
        lattice.voxel *= kStep;
        return;
    }
    lattice.wanted *= kStep;
    lacksLevels_ = lacksLevels_ || in.volumes[size_t(effect.volume)].isFine;
    chooseLevel(lattice, in.volumes[size_t(effect.volume)]);
}

/// The level whose voxels are nearest to the wanted side, or finer.
void FieldPlan::chooseLevel(Lattice& lattice, const FieldVolume& volume)
{
    const float side = float(volume.side);
    const int level = int(std::floor(std::log2(lattice.wanted / side) + 0.5f));
    lattice.wantsCoarser = volume.isFine && level > 0;
    lattice.level = volume.isFine ? 0 : std::clamp(level, 0, base::kMostVolumeLevel);
    lattice.voxel = std::ldexp(side, lattice.level);
}

/// [m] How far from the center of a ball there may be medium in the voxels, with a margin. Around the center
/// of a brick of a volume in the axes of the world, only this brick is wanted.
float FieldPlan::reachOf(const BlobInstance& ball, const BlobEffect& effect, const Lattice& lattice,
                         const FieldPlanInputs& in)
{
    if (effect.volume < 0)
        return std::max(ball.centerRadius.w, leastRadius(lattice.voxel)) * kTouch;
    const FieldVolume& volume = in.volumes[size_t(effect.volume)];
    if (volume.isAligned && lattice.level == 0)
        return kWithinBrick * lattice.voxel;
    const float wider = lattice.level == 0 ? 0.0f : kCoarseReach * lattice.voxel;
    return brickReach(float(volume.side)) * kTouch + wider;
}

bool FieldPlan::isLoose(const BlobInstance& ball, const BlobEffect& effect, float voxel)
{
    const bool isFire = ball.layer.x < 2.0f;
    return effect.volume < 0 && ball.centerRadius.w < std::max(kLooseShare * effect.radius,
                                                               (isFire ? kLooseFire : kLooseVoxels) * voxel);
}

/// From the whole effect, so that voxels stay as large when the view turns.
void FieldPlan::chooseVoxels(const FieldPlanInputs& in)
{
    const CameraGeometry& camera = *in.camera;
    const float pixelsPerSlope = 0.5f * float(in.height) * std::abs(camera.clipScale.y);
    const float perRadius = float(std::clamp(in.resolution, kMinVoxels, kMaxVoxels)) / kRadii;
    base::assignAmortized(lattices_, in.effects.size(), Lattice());
    for (size_t i = 0; i < in.effects.size(); ++i) {
        const BlobEffect& effect = in.effects[i];
        const float depth = camera.orthographic ? 1.0f : distanceToBox(effect.low, effect.high);
        const float pixel = depth / pixelsPerSlope; // [m]
        if (effect.volume >= 0) {
            const FieldVolume& volume = in.volumes[size_t(effect.volume)];
            lattices_[i].wanted = std::max({float(volume.side), kPixelsPerVoxel * pixel, kMinVoxel});
            chooseLevel(lattices_[i], volume);
            continue;
        }
        lattices_[i].voxel =
            quantized(std::max({effect.radius / perRadius, kPixelsPerVoxel * pixel, kMinVoxel}));
    }
}

/// The box around the balls that can be seen, as wide as voxels make them.
void FieldPlan::bound(Lattice& lattice, const FieldPlanInputs& in, const BlobEffect& effect)
{
    lattice.low = glm::vec3(std::numeric_limits<float>::max());
    lattice.high = -lattice.low;
    for (uint32_t ball = effect.begin; ball < effect.end; ++ball) {
        if (isLoose(in.balls[ball], effect, lattice.voxel))
            continue;
        const glm::vec4& place = in.balls[ball].centerRadius;
        const float radius = reachOf(in.balls[ball], effect, lattice, in);
        lattice.low = glm::min(lattice.low, glm::vec3(place) - radius);
        lattice.high = glm::max(lattice.high, glm::vec3(place) + radius);
    }
}

/// The box of bricks of one field.  @return false: it has too many
bool FieldPlan::placeField(Lattice& lattice, const BlobEffect& effect, const FieldPlanInputs& in)
{
    const double side = double(lattice.voxel) * kBrickCells;
    const FieldVolume* const volume = effect.volume >= 0 ? &in.volumes[size_t(effect.volume)] : nullptr;
    // relative to the eye; its own lattice moves with a volume
    const glm::dvec3 anchor = volume && volume->isAligned ? volume->origin : -in.camera->eye;
    FieldBlock field{};
    glm::dvec3 corner;
    int64_t count = 1;
    for (int a = 0; a < 3; ++a) {
        const double first = std::floor((double(lattice.low[a]) - anchor[a]) / side);
        const double last = std::floor((double(lattice.high[a]) - anchor[a]) / side);
        if (last - first >= double(kMaxBricksPerAxis))
            return false;
        field.bricks[a] = int(last - first) + 1;
        corner[a] = first * side + anchor[a];
        count *= field.bricks[a];
    }
    if (count > kMaxBoxBricks)
        return false;
    field.corner = glm::vec4(glm::vec3(corner), lattice.voxel);
    field.bricks.w = int(table_.size());
    field.limits.x = leastRadius(lattice.voxel);
    if (volume) {
        field.limits.x =
            -std::max(base::kVolumeCasterRadius * float(volume->side), leastRadius(lattice.voxel));
        field.limits.y = volume->largest;
    }
    field.limits.z = float(effect.detail + 1);
    base::reserveAmortized(table_, table_.size() + size_t(count));
    table_.resize(table_.size() + size_t(count), 0u);
    lattice.field = uint32_t(fields_.size());
    fields_.push_back(field);
    return true;
}

bool FieldPlan::place(const FieldPlanInputs& in)
{
    fields_.clear();
    table_.clear();
    for (size_t i = 0; i < lattices_.size(); ++i) {
        Lattice& lattice = lattices_[i];
        bound(lattice, in, in.effects[i]);
        for (int k = 0; k < kMaxTries && lattice.hasBalls() && !placeField(lattice, in.effects[i], in); ++k) {
            enlarge(lattice, in.effects[i], in); // a wide effect
            bound(lattice, in, in.effects[i]);
        }
    }
    return lacksLevels_ || countBalls(in);
}

/// Counts the balls of each brick in the table, and leaves out bricks that are not in the view.
/// @return false if there are more bricks than the budgets allow
bool FieldPlan::countBalls(const FieldPlanInputs& in)
{
    for (size_t e = 0; e < in.effects.size(); ++e)
        for (uint32_t i = in.effects[e].begin; i < in.effects[e].end; ++i) {
            if (isLoose(in.balls[i], in.effects[e], lattices_[e].voxel))
                continue;
            const FieldBlock& field = fields_[lattices_[e].field];
            BrickRange(field, in.balls[i], reachOf(in.balls[i], in.effects[e], lattices_[e], in))
                .forEach(field, [&](size_t index) { ++table_[index]; });
        }
    const ViewVolume volume(*in.camera);
    uint32_t bricks = 0, ofVolumes = 0;
    for (const FieldBlock& field : fields_) {
        uint32_t& counted = field.limits.x < 0.0f ? ofVolumes : bricks;
        const float side = field.corner.w * float(kBrickCells);
        size_t index = size_t(field.bricks.w);
        for (int z = 0; z < field.bricks.z; ++z)
            for (int y = 0; y < field.bricks.y; ++y)
                for (int x = 0; x < field.bricks.x; ++x, ++index) {
                    if (table_[index] == 0)
                        continue;
                    const glm::vec3 middle = glm::vec3(field.corner) + side * (glm::vec3(x, y, z) + 0.5f);
                    if (volume.touches(middle, brickReach(field.corner.w)))
                        ++counted;
                    else
                        table_[index] = kUnseen;
                }
    }
    const uint32_t across = uint32_t(std::clamp(in.resolution, kMinVoxels, kMaxVoxels) / kBrickCells);
    const uint32_t most = in.mostBricks > 0 ? in.mostBricks : across * across * across;
    isOverBalls_ = bricks > most;
    isOverVolumes_ = ofVolumes > kVolumeBudget * most || (ofVolumes > 0 && bricks + ofVolumes > kMostBricks);
    return !isOverBalls_ && !isOverVolumes_;
}

/// Gives numbers to bricks in the order of the table. Their counts are those of countBalls().
void FieldPlan::listBricks()
{
    uint32_t firstBall = 0;
    for (uint32_t f = 0; f < fields_.size(); ++f) {
        const glm::ivec4& size = fields_[f].bricks;
        size_t index = size_t(size.w);
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x, ++index) {
                    const uint32_t count = table_[index] == kUnseen ? 0u : table_[index];
                    table_[index] = count > 0 ? uint32_t(bricks_.size()) + 1 : 0u;
                    if (count == 0)
                        continue;
                    bricks_.push_back({f, uint32_t(x) | uint32_t(y) << 10 | uint32_t(z) << 20, firstBall, 0});
                    firstBall += count;
                }
    }
    base::reserveAmortized(balls_, firstBall);
    balls_.resize(firstBall);
    base::assignAmortized(peaks_, bricks_.size(), 0.0f);
}

void FieldPlan::listVolumes(const FieldPlanInputs& in)
{
    for (size_t e = 0; e < in.effects.size(); ++e)
        if (in.effects[e].volume >= 0 && lattices_[e].hasBalls())
            volumes_.push_back({lattices_[e].field, uint32_t(in.effects[e].volume), lattices_[e].level, 0, 0,
                                lattices_[e].wantsCoarser});
    std::ranges::sort(volumes_, {}, &PlacedVolume::field);
    for (PlacedVolume& placed : volumes_) {
        const auto first = std::ranges::lower_bound(bricks_, placed.field, {}, &FieldBrickBlock::field);
        const auto last = std::ranges::upper_bound(bricks_, placed.field, {}, &FieldBrickBlock::field);
        placed.firstBrick = uint32_t(first - bricks_.begin());
        placed.brickCount = uint32_t(last - first);
    }
}

void FieldPlan::listBalls(const FieldPlanInputs& in)
{
    const bool choosesNetworks = in.networkCells > 0 && in.choosesNetworks;
    base::assignAmortized(emitted_, fields_.size(), 0.0f);
    base::assignAmortized(media_, choosesNetworks ? fields_.size() : 0, MediumMoments());
    for (size_t e = 0; e < in.effects.size(); ++e)
        for (uint32_t i = in.effects[e].begin; i < in.effects[e].end; ++i) {
            const BlobInstance& ball = in.balls[i];
            if (isLoose(ball, in.effects[e], lattices_[e].voxel)) {
                loose_.push_back(i);
                continue;
            }
            listBall(fields_[lattices_[e].field], ball, reachOf(ball, in.effects[e], lattices_[e], in), i);
            emitted_[lattices_[e].field] +=
                ball.medium.x * (ball.emission.x + ball.emission.y + ball.emission.z) / 3.0f;
            if (choosesNetworks)
                media_[lattices_[e].field].add(glm::dvec3(ball.centerRadius), double(ball.centerRadius.w),
                                               double(ball.medium.x), glm::dvec3(ball.scatter));
        }
    for (size_t i = 0; i < bricks_.size(); ++i) {
        FieldBlock& field = fields_[bricks_[i].field];
        if (field.limits.x > 0.0f)
            field.limits.y = std::max(field.limits.y, peaks_[i]);
    }
}

/// A parallel view has no place from which balls are near.
void FieldPlan::listNear(const FieldPlanInputs& in)
{
    if (in.camera->orthographic)
        return;
    for (size_t e = 0; e < in.effects.size(); ++e) {
        const BlobEffect& effect = in.effects[e];
        const Lattice& lattice = lattices_[e];
        if (effect.volume >= 0 ||
            distanceToBox(effect.low, effect.high) > FieldNearPlan::kReach * lattice.voxel)
            continue;
        for (uint32_t i = effect.begin; i < effect.end; ++i)
            if (!isLoose(in.balls[i], effect, lattice.voxel))
                near_.add(i, lattice.field, effect.detail, in.balls[i].centerRadius, lattice.voxel);
    }
    near_.choose();
    for (const NearBall& ball : near_.balls()) {
        const FieldBlock& field = fields_[ball.field];
        const float reach = std::max(in.balls[ball.number].centerRadius.w, field.limits.x) * kTouch;
        BrickRange(field, in.balls[ball.number], reach).forEach(field, [&](size_t index) {
            if (table_[index] != 0)
                near_.addToBrick(table_[index] - 1, ball);
        });
    }
    near_.listBricks();
}

void FieldPlan::listBall(const FieldBlock& field, const BlobInstance& ball, float reach, uint32_t number)
{
    const float radius = std::max(ball.centerRadius.w, field.limits.x);
    const float fineness = field.corner.w * field.corner.w / (radius * radius);
    const float peak = formula::fxKernelPeak(ball.medium.x, radius) * formula::fxVoxelKernel(0.0f, fineness);
    BrickRange(field, ball, reach).forEach(field, [&](size_t index) {
        if (table_[index] == 0)
            return;
        FieldBrickBlock& brick = bricks_[table_[index] - 1];
        balls_[brick.first + brick.count++] = number;
        peaks_[table_[index] - 1] += peak;
    });
}

glm::vec3 FieldPlan::middleOf(const FieldBrickBlock& brick) const
{
    const FieldBlock& field = fields_[brick.field];
    const glm::vec3 place(brick.place & 1023u, (brick.place >> 10) & 1023u, brick.place >> 20);
    return glm::vec3(field.corner) + field.corner.w * float(kBrickCells) * (place + 0.5f);
}

void FieldPlan::markTiles(const FieldPlanInputs& in, const FieldBrickBlock& brick)
{
    // layers smaller than the picture may reach beyond it by less than a texel of theirs, 4 pixels
    const float margin = 8.0f / float(std::max(std::min(in.width, in.height), 1));
    const CameraGeometry& camera = *in.camera;
    const glm::vec3 middle = middleOf(brick);
    const float reach = brickReach(fields_[brick.field].corner.w), depth = glm::dot(middle, camera.forward);
    const int tiles[2] = {kFieldTileColumns, kFieldTileRows};
    int first[2], last[2];
    for (int axis = 0; axis < 2; ++axis) {
        const float c = glm::dot(middle, axis == 0 ? camera.right : camera.up);
        const auto [low, high] = clipRange(camera, axis, c, depth, reach);
        if (high + margin < -1.0f || low - margin > 1.0f)
            return;
        const auto tileOf = [&](float clip) {
            return int(std::clamp((0.5f + 0.5f * clip) * float(tiles[axis]), 0.0f, float(tiles[axis] - 1)));
        };
        first[axis] = tileOf(low - margin);
        last[axis] = tileOf(high + margin);
    }
    for (int row = first[1]; row <= last[1]; ++row)
        for (int column = first[0]; column <= last[0]; ++column) {
            uint32_t& stamp = stamps_[size_t(row * kFieldTileColumns + column)];
            if (stamp != brick.field + 1)
                seen_.insert(seen_.end(), {uint32_t(row * kFieldTileColumns + column), brick.field});
            stamp = brick.field + 1;
        }
}

void FieldPlan::listTiles(const FieldPlanInputs& in)
{
    stamps_.assign(size_t(kFieldTiles), 0u);
    seen_.clear();
    for (const FieldBrickBlock& brick : bricks_)
        markTiles(in, brick);
    tiles_.assign(bricks_.empty() ? 0 : size_t(kFieldTiles), FieldTileBlock{0, 0});
    for (size_t i = 0; i < seen_.size(); i += 2)
        ++tiles_[seen_[i]].count;
    uint32_t first = 0;
    for (size_t tile = 0; tile < tiles_.size(); ++tile) {
        tiles_[tile].first = stamps_[tile] = first; // from here on: where its list goes on
        first += tiles_[tile].count;
    }
    base::reserveAmortized(tileFields_, first);
    tileFields_.resize(first);
    for (size_t i = 0; i < seen_.size(); i += 2)
        tileFields_[stamps_[seen_[i]]++] = seen_[i + 1];
}

} // namespace fx::render
