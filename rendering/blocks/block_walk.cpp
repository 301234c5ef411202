#include "rendering/blocks/block_walk.h"

#include "rendering/frame/ball_window.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

namespace blob = base::blob_column;
namespace block = base::block_column;
using base::BlockFrame;
using base::SnapshotGroup;
using base::vectorAt;

/// [1] Share of BlockWalkSettings::maxPixels, and of its error, from which the content fades in.
constexpr float kFadePixels = 0.8f, kFadeError = 0.8f;
/// [1] Distance over the radius below which a block is its content, and from which it is an impostor alone.
constexpr float kNearest = 1.5f, kFar = 2.0f;

bool isFinite(const glm::vec3& center, float radius, float crossSection)
{
    const float sum = glm::dot(center, center) + radius * radius + crossSection;
    return std::isfinite(sum);
}

/// Reads the blocks of the effect at a moment between two snapshots.
class RootReader
{
public:
    RootReader(const SnapshotGroup& newer, const SnapshotGroup* older, float t, float stepSeconds)
        : newer_(newer), older_(older), t_(t), stepSeconds_(stepSeconds)
    {}

    /// The block in row i; rows must be read in rising order.
    /// @return false if it is not yet born at this moment
    bool read(uint32_t i, const BlockFrame& outer, BlockFrame& out)
    {
        out = outer.inside(newer_, i);
        i_ = i;
        hasOld_ = false;
        position_ = vectorAt(newer_, block::PositionX, i);
        if (!older_)
            return true;
        const uint64_t id = newer_.ids()[i];
        while (j_ < older_->count() && older_->ids()[j_] < id)
            ++j_;
        if (j_ == older_->count() || older_->ids()[j_] != id) {
            out.position -= (1.0f - t_) * stepSeconds_ * (out.velocity - outer.velocity);
            position_ -= (1.0f - t_) * stepSeconds_ * vectorAt(newer_, block::VelocityX, i);
            return newer_.start(block::Age)[i] >= (1.0f - t_) * stepSeconds_;
        }
        hasOld_ = true;
        position_ = glm::mix(vectorAt(*older_, block::PositionX, uint32_t(j_)), position_, t_);
        const BlockFrame before = outer.inside(*older_, uint32_t(j_));
        out.position = glm::mix(before.position, out.position, t_);
        out.scale = glm::mix(before.scale, out.scale, t_);
        out.density = glm::mix(before.density, out.density, t_);
        return true;
    }

    /// Offsets of the noise coordinates of the block that was read last.
    std::array<glm::vec3, 2> carried(const BlobDetail& detail) const
    {
        return detail.isGiven() ? detail.carried(i_, j_, hasOld_, position_) : std::array<glm::vec3, 2>();
    }

private:
    const SnapshotGroup& newer_;
    const SnapshotGroup* older_;
    float t_, stepSeconds_;
    size_t i_ = 0, j_ = 0;
    bool hasOld_ = false;
    glm::vec3 position_{0.0f}; ///< [m] in the space of the effect
};

} // namespace

BlockWalk::BlockWalk(const CameraGeometry& camera, int height, BlockTiles& tiles,
                     std::pmr::vector<GatheredBlob>& balls, std::pmr::vector<MediumCaster>& casters,
                     std::pmr::vector<BlockRecord>& records)
    : camera_(camera), volume_(camera), pixelsPerSlope_(0.5f * float(height) * std::abs(camera.clipScale.y)),
      tiles_(tiles), balls_(balls), casters_(casters), records_(records)
{}

void BlockWalk::run(const base::BlockGroups& groups, const BlockContents& contents,
                    const SnapshotGroup* older, float t, float stepSeconds, double seconds,
                    const base::Placement& place, const GatheredBlob& like, const BlobDetail& detail,
                    const BlockWalkSettings& settings)
{
    groups_ = &groups;
    contents_ = &contents;
    settings_ = &settings;
    like_ = like;
    instance_ = groups.root().info().instance;
    seconds_ = seconds;
    effectBalls_ = contentCasters_ = 0;
    back_ = older ? (1.0f - t) * stepSeconds : 0.0f;
    BlockFrame outer;
    outer.position = glm::vec3(place.position);
    outer.rotation = place.rotation;
    outer.scale = place.scale;
    const SnapshotGroup& root = groups.root();
    uint64_t all = 0;
    for (uint32_t i = 0; i < root.count(); ++i)
        all += contents.of(base::BlockGroups::variantIn(root, i)).balls;
    castsBalls_ = all <= settings.maxCasters;
    errorBalls_ = all <= settings.maxBalls ? settings.maxBalls : settings.maxBalls / 2;
    if (!castsBalls_) // so many in one place would be drawn as a sample of them
        errorBalls_ = std::min(errorBalls_, settings.maxCasters / 4);
    // Blocks around the eye have no impostors: they are the first to get balls.
    for (const bool isForNear : {true, false}) {
        RootReader reader(root, older, t, stepSeconds);
        for (uint32_t i = 0; i < root.count(); ++i) {
            BlockFrame frame;
            if (!reader.read(i, outer, frame))
                continue;
            const uint32_t variant = base::BlockGroups::variantIn(root, i);
            if (isForNear != isNear(frame, frame.scale * contents.of(variant).radius))
                continue;
            if (castsBalls_)
                addBallCasters(frame, variant);
            like_.carried = reader.carried(detail); // of all that is in the block
            visit(frame, variant, 1.0f);
        }
    }
}

/// Whether the eye is so near that a block is its content, at least in part.
bool BlockWalk::isNear(const BlockFrame& frame, float radius) const
{
    return !camera_.orthographic && glm::length(frame.position) < kFar * radius;
}

/// Share of a block that is drawn as an impostor; the rest is drawn as its content.
float BlockWalk::impostorShare(const BlockFrame& frame, float radius, float& outPixels) const
{
    const float distance = camera_.orthographic ? 1.0f : glm::length(frame.position);
    outPixels = 2.0f * radius * pixelsPerSlope_ / std::max(distance, 1e-6f);
    const float most = std::max(settings_->maxPixels, 1e-3f);
    float share = 1.0f - glm::smoothstep(kFadePixels * most, most, outPixels);
    if (!camera_.orthographic)
        share *= glm::smoothstep(kNearest * radius, kFar * radius, distance);
    return share;
}

/// Chooses the tile of a block by the error that is predicted.
/// @return share of the block that may be drawn as an impostor
float BlockWalk::shareByError(const BlockFrame& frame, TileRequest& io) const
{
    const BlockContent& content = *io.content;
    if (!settings_->errors || !(settings_->error > 0.0f) || !hasTiles(content))
        return 1.0f;
    tiles_.countBlock();
    const TileErrors* const errors = settings_->errors->find(io.variant, *contents_, seconds_);
    if (!errors)
        return io.isOptional ? 0.0f : 1.0f;
    const TileChoice choice =
        chooseTile(errorAt(*errors, frame.density), sourceOf(content, settings_->exposure),
                   {io.pixels, io.nearness, tiles_.finest()}, settings_->error);
    io.texels = choice.texels;
    io.angle = choice.angle;
    return io.isOptional ? 1.0f - glm::smoothstep(kFadeError, 1.0f, choice.least / settings_->error) : 1.0f;
}

/// Blocks have at most kMaxBlockLevels levels, which bounds the recursion.
void BlockWalk::visit(const BlockFrame& frame, uint32_t variant, float weight)
{
    const BlockContent& content = contents_->of(variant);
    const float radius = frame.scale * content.radius;
    if (!content.group || content.balls == 0 || !(weight * frame.density > 0.0f) || !(radius > 0.0f))
        return;
    const float section = weight * frame.density * frame.scale * frame.scale * content.crossSection;
    const float sum = content.albedo.x + content.albedo.y + content.albedo.z + content.light.x +
                      content.light.y + content.light.z + glm::dot(frame.rotation, frame.rotation);
    if (!isFinite(frame.position, radius, section) || !std::isfinite(sum)) {
        ++counts_.nonFinite;
        return;
    }
    if (!volume_.touches(frame.position, radius)) {
        ++counts_.culled;
        addBlockCasters(frame, variant, weight);
        return;
    }
    float pixels = 0.0f;
    float share = impostorShare(frame, radius, pixels);
    const bool isBalls = !groups_->isBlocks(*content.group);
    const bool isFull = isBalls && uint64_t(effectBalls_) + content.balls > settings_->maxBalls;
    if (isFull) {
        if (!camera_.orthographic && glm::length(frame.position) < kNearest * radius) {
            // Around the eye there is no impostor: as many balls as may be drawn are better than none.
            addBlockCasters(frame, variant, weight);
            addBalls(frame, *content.group, weight,
                     settings_->maxBalls - std::min(effectBalls_, settings_->maxBalls));
            return;
        }
        share = 1.0f;
    }
    share =
        share > 0.0f && section > 0.0f ? drawImpostor(frame, variant, weight, share, pixels, isFull) : 0.0f;
    if (share >= 1.0f)
        return;
    if (isFull) { // no tile and no room for its balls
        addWholeBall(frame, content, weight);
        addBlockCasters(frame, variant, weight);
        return;
    }
    const float rest = weight * (1.0f - share);
    if (isBalls) {
        addDrawnCasters(frame, variant, rest);
        addBalls(frame, *content.group, rest, UINT32_MAX);
        return;
    }
    for (uint32_t i = 0; i < content.group->count(); ++i)
        visit(frame.inside(*content.group, i), base::BlockGroups::variantIn(*content.group, i), rest);
}

/// Draws a share of a block as an impostor, or less of it because of its error.
/// @param isFull the error does not count: there is no room for the content
/// @return what is drawn as an impostor
float BlockWalk::drawImpostor(const BlockFrame& frame, uint32_t variant, float weight, float share,
                              float pixels, bool isFull)
{
    const BlockContent& content = contents_->of(variant);
    const glm::vec3 towards = camera_.orthographic ? camera_.forward : glm::normalize(frame.position);
    TileRequest request{variant, &content, glm::conjugate(frame.rotation) * towards, pixels, seconds_};
    request.nearness =
        camera_.orthographic ? 0.0f : frame.scale * content.radius / glm::length(frame.position);
    request.density = frame.density;
    // What has a large error must not use up the balls of what is near or large. The blocks in a block are
    // chosen one by one.
    request.isOptional = groups_->isBlocks(*content.group) ||
                         (uint64_t(effectBalls_) + content.balls <= errorBalls_ && canCastBalls(content));
    const float exact = shareByError(frame, request);
    share *= isFull ? 1.0f : exact;
    const auto tile = share > 0.0f ? tiles_.find(request) : std::nullopt;
    if (!tile)
        return 0.0f;
    addImpostor(frame, content, *tile, weight * share);
    addBlockCasters(frame, variant, weight * share);
    return share;
}

/// A ball with the medium of a block, without a tile.
/// @param center, radius [m] in units of the block
GatheredBlob BlockWalk::wholeBall(const BlockFrame& frame, const BlockContent& content, float weight,
                                  const glm::vec3& center, float radius) const
{
    const float section = frame.scale * frame.scale * content.crossSection;
    GatheredBlob ball = like_;
    ball.center = frame.position + frame.turned(center);
    ball.radius = std::max(frame.scale * radius, leastRadius(ball.center));
    ball.crossSection =
        formula::fxWidenedSection(weight * frame.density * section, frame.scale * radius, ball.radius);
    ball.albedo = content.albedo;
    ball.emission = content.light;
    ball.temperature = 0.0f;
    ball.fireShare = glm::clamp(content.fireShare, 0.0f, 1.0f);
    ball.heat = content.heat;
    ball.velocity = frame.velocity;
    ball.seed = detailSeed(frame.id);
    ball.rank = listRank(instance_, frame.id, 0);
    return ball;
}

void BlockWalk::addWholeBall(const BlockFrame& frame, const BlockContent& content, float weight)
{
    balls_.push_back(wholeBall(frame, content, weight, content.middle, content.momentRadius));
    ++counts_.impostors;
}

void BlockWalk::addImpostor(const BlockFrame& frame, const BlockContent& content, const Tile& tile,
                            float weight)
{
    GatheredBlob ball = wholeBall(frame, content, weight, glm::vec3(0.0f), content.radius);
    const float section = frame.scale * frame.scale * content.crossSection;
    const float perWidth = frame.scale * content.radius / ball.radius;
    const float middle = glm::dot(content.middle, tile.axes.along) / content.radius;
    const float steps = std::round(127.0f * (1.0f + glm::clamp(middle, -1.0f, 1.0f)));
    records_.push_back({{frame.rotation * tile.axes.right, steps + tile.nearness},
                        {frame.rotation * tile.axes.up, perWidth * perWidth / section},
                        {float(tile.size), float(tile.corner.x), float(tile.corner.y),
                         content.isColored ? tile.brightest * settings_->exposure : -1.0f},
                        {content.peak * content.radius * content.radius * content.radius /
                             std::max(content.crossSection, 1e-30f),
                         0.0f, 0.0f, 0.0f}});
    ball.tile = uint32_t(records_.size());
    balls_.push_back(ball);
    ++counts_.impostors;
}

/// [m] Radius of the smallest ball that is drawn there.
float BlockWalk::leastRadius(const glm::vec3& center) const
{
    return kMinPixels * (camera_.orthographic ? 1.0f : glm::length(center)) / pixelsPerSlope_;
}

void BlockWalk::addBalls(const BlockFrame& frame, const SnapshotGroup& group, float weight, uint32_t most)
{
    const glm::vec3 tint = base::tintOf(group.constants(), base::block_ball_constant::ShadeR);
    const float section = weight * frame.density * frame.scale * frame.scale;
    const uint64_t end = uint64_t(effectBalls_) + most;
    for (uint32_t i = 0; i < group.count() && effectBalls_ < end; ++i) {
        GatheredBlob ball = like_;
        ball.center = frame.position + frame.turned(vectorAt(group, blob::PositionX, i) -
                                                    back_ * vectorAt(group, blob::VelocityX, i));
        ball.radius = frame.scale * group.start(blob::Radius)[i];
        ball.crossSection = section * group.start(blob::CrossSection)[i];
        if (!isFinite(ball.center, ball.radius, ball.crossSection)) {
            ++counts_.nonFinite;
            continue;
        }
        if (!(ball.crossSection > 0.0f && ball.radius > 0.0f))
            continue;
        if (const float least = leastRadius(ball.center); ball.radius < least) {
            ball.crossSection = formula::fxWidenedSection(ball.crossSection, ball.radius, least);
            ball.radius = least;
        }
        if (!volume_.touches(ball.center, ball.radius)) {
            ++counts_.culled;
            continue;
        }
        ball.temperature = group.start(blob::Temperature)[i];
        ball.tint = tint;
        ball.albedo = vectorAt(group, blob::AlbedoR, i);
        ball.emission = vectorAt(group, blob::EmissionR, i);
        ball.fireShare = glm::clamp(group.start(blob::FireShare)[i], 0.0f, 1.0f);
        ball.heat = group.start(blob::Heat)[i];
        ball.velocity = frame.velocity + frame.turned(vectorAt(group, blob::VelocityX, i));
        const uint64_t id = frame.id + group.ids()[i];
        ball.seed = detailSeed(id);
        ball.rank = listRank(instance_, id, 0);
        balls_.push_back(ball);
        ++effectBalls_;
    }
}

void BlockWalk::addCaster(const glm::vec3& center, float radius, float crossSection)
{
    if (isFinite(center, radius, crossSection) && radius > 0.0f && crossSection > 0.0f)
        casters_.push_back({center, radius, crossSection});
}

bool BlockWalk::canCastBalls(const BlockContent& content) const
{
    return castsBalls_ || uint64_t(contentCasters_) + content.balls <= settings_->maxCasters;
}

void BlockWalk::addContentCasters(const BlockFrame& frame, const SnapshotGroup& group, float weight)
{
    const float section = weight * frame.density * frame.scale * frame.scale;
    for (uint32_t i = 0; i < group.count(); ++i)
        addCaster(frame.position + frame.turned(vectorAt(group, blob::PositionX, i) -
                                                back_ * vectorAt(group, blob::VelocityX, i)),
                  frame.scale * group.start(blob::Radius)[i], section * group.start(blob::CrossSection)[i]);
}

/// Casters of a block that is drawn as its balls, where these are not casters already.
void BlockWalk::addDrawnCasters(const BlockFrame& frame, uint32_t variant, float weight)
{
    const BlockContent& content = contents_->of(variant);
    if (castsBalls_)
        return;
    if (!canCastBalls(content)) {
        addBlockCasters(frame, variant, weight);
        return;
    }
    addContentCasters(frame, *content.group, weight);
    contentCasters_ += content.balls;
}

/// All balls in a block cast shadows.
void BlockWalk::addBallCasters(const BlockFrame& frame, uint32_t variant)
{
    const BlockContent& content = contents_->of(variant);
    if (!content.group || content.balls == 0)
        return;
    if (!groups_->isBlocks(*content.group)) {
        addContentCasters(frame, *content.group, 1.0f);
        return;
    }
    for (uint32_t i = 0; i < content.group->count(); ++i)
        addBallCasters(frame.inside(*content.group, i), base::BlockGroups::variantIn(*content.group, i));
}

/// In an effect of very many balls each block of balls that is not drawn as these casts the shadow of one
/// ball with the same mass, mean and second moment: balls would be too dark in the shadow of the ball that
/// their own block casts.
void BlockWalk::addBlockCasters(const BlockFrame& frame, uint32_t variant, float weight)
{
    const BlockContent& content = contents_->of(variant);
    if (castsBalls_ || !content.group || content.balls == 0)
        return;
    if (!groups_->isBlocks(*content.group)) {
        addCaster(frame.position + frame.turned(content.middle), frame.scale * content.momentRadius,
                  weight * frame.density * frame.scale * frame.scale * content.crossSection);
        return;
    }
    for (uint32_t i = 0; i < content.group->count(); ++i)
        addBlockCasters(frame.inside(*content.group, i), base::BlockGroups::variantIn(*content.group, i),
                        weight);
}

} // namespace fx::render
