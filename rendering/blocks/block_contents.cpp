#include "rendering/blocks/block_contents.h"

#include "foundation/math/hash.h"
#include "rendering/optics/black_body.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fx::render {

namespace {

namespace blob = base::blob_column;
using base::SnapshotGroup;
using base::vectorAt;

/// Light per optical depth, as of thin gas.
glm::vec3 lightOf(const SnapshotGroup& group, uint32_t i, const glm::vec3& albedo)
{
    const glm::vec3 tint = base::tintOf(group.constants(), base::block_ball_constant::ShadeR);
    return (1.0f - albedo) * tint * blackBodyLuminance(group.start(blob::Temperature)[i]) +
           vectorAt(group, blob::EmissionR, i);
}

/// Mean square distance from the center of the quartic kernel, over the square of its radius.
constexpr double kKernelMoment = 1.0 / 3.0;

/// Sums over up to a million balls, in double precision.
class ContentSum
{
public:
    void add(const BlockContent& more, float crossSection)
    {
        const auto section = double(crossSection);
        section_ += section;
        const glm::dvec3 middle(more.middle);
        const auto radius = double(more.momentRadius);
        middle_ += section * middle;
        moment_ += section * (glm::dot(middle, middle) + kKernelMoment * radius * radius);
        albedo_ += section * glm::dvec3(more.albedo);
        light_ += section * glm::dvec3(more.light);
        fireShare_ += section * double(more.fireShare);
        heat_ += section * double(more.heat);
        peak_ += section * double(more.peak);
        sum.brightest = glm::max(sum.brightest, more.brightest);
        sum.isColored = sum.isColored || more.isColored;
        sum.balls += std::min(more.balls, std::numeric_limits<uint32_t>::max() - sum.balls);
    }
    /// The sum, with means.
    BlockContent finished() const
    {
        BlockContent content = sum;
        const double per = 1.0 / std::max(section_, double(std::numeric_limits<float>::min()));
        content.crossSection = float(section_);
        const glm::dvec3 middle = per * middle_;
        content.middle = glm::vec3(middle);
        content.momentRadius =
            float(std::sqrt(std::max(per * moment_ - glm::dot(middle, middle), 0.0) / kKernelMoment));
        content.albedo = glm::vec3(per * albedo_);
        content.light = glm::vec3(per * light_);
        content.fireShare = float(per * fireShare_);
        content.heat = float(per * heat_);
        content.peak = float(per * peak_);
        return content;
    }

    BlockContent sum; ///< what is neither a sum nor a mean

private:
    double section_ = 0.0, moment_ = 0.0, fireShare_ = 0.0, heat_ = 0.0, peak_ = 0.0;
    glm::dvec3 middle_{0.0}, albedo_{0.0}, light_{0.0};
};

} // namespace

BlockContent BlockContents::sumOfBalls(const SnapshotGroup& group) const
{
    ContentSum all;
    BlockContent& sum = all.sum;
    for (uint32_t i = 0; i < group.count(); ++i) {
        BlockContent ball;
        ball.middle = vectorAt(group, blob::PositionX, i);
        ball.albedo = vectorAt(group, blob::AlbedoR, i);
        ball.light = ball.brightest = lightOf(group, i, ball.albedo);
        ball.fireShare = group.start(blob::FireShare)[i];
        ball.heat = group.start(blob::Heat)[i];
        ball.balls = 1;
        const float section = group.start(blob::CrossSection)[i], radius = group.start(blob::Radius)[i];
        ball.momentRadius = radius;
        ball.peak = section / std::max(radius * radius * radius, 1e-30f);
        all.add(ball, section);
        sum.isColored = sum.isColored || ball.albedo != vectorAt(group, blob::AlbedoR, 0) ||
                        group.start(blob::Temperature)[i] != group.start(blob::Temperature)[0] ||
                        vectorAt(group, blob::EmissionR, i) != vectorAt(group, blob::EmissionR, 0);
        sum.speed = std::max(sum.speed, glm::length(vectorAt(group, blob::VelocityX, i)));
        sum.isAnimated = sum.isAnimated || group.start(blob::Age)[i] != base::kSettledAge;
    }
    return all.finished();
}

BlockContent BlockContents::sumOfBlocks(const SnapshotGroup& group) const
{
    ContentSum all;
    BlockContent& sum = all.sum;
    const BlockContent* first = nullptr;
    for (uint32_t i = 0; i < group.count(); ++i) {
        const BlockContent& inner = contents_[base::BlockGroups::variantIn(group, i)];
        if (!inner.group || inner.balls == 0)
            continue;
        const float scale = group.start(base::block_column::Scale)[i];
        const base::BlockFrame frame = base::BlockFrame().inside(group, i);
        BlockContent placed = inner;
        placed.middle = frame.position + frame.turned(inner.middle);
        placed.momentRadius = scale * inner.momentRadius;
        placed.peak = inner.peak * frame.density / std::max(scale, 1e-30f);
        all.add(placed, group.start(base::block_column::Density)[i] * scale * scale * inner.crossSection);
        sum.speed = std::max(sum.speed, scale * inner.speed);
        sum.isAnimated = sum.isAnimated || inner.isAnimated;
        first = first ? first : &inner;
        sum.isColored = sum.isColored || inner.albedo != first->albedo || inner.light != first->light;
    }
    return all.finished();
}

uint64_t BlockContents::identityOf(const SnapshotGroup& group, uint32_t variant,
                                   const BlockContent& content) const
{
    const base::GroupInfo& info = group.info();
    if (content.isAnimated)
        return base::hashWord(base::hashWord(info.instance, info.solver), variant);
    uint64_t hash = base::hashWord(1, uint64_t(groups_->isBlocks(group)));
    const size_t columns =
        groups_->isBlocks(group) ? size_t(base::block_column::Variant) : size_t(blob::Count);
    for (size_t k = 0; k < columns; ++k)
        hash = base::hashBytes(hash, group.start(k), group.count() * sizeof(float));
    for (uint32_t i = 0; groups_->isBlocks(group) && i < group.count(); ++i)
        hash = base::hashWord(hash, contents_[base::BlockGroups::variantIn(group, i)].identity);
    return hash;
}

void BlockContents::build(const base::BlockGroups& groups)
{
    groups_ = &groups;
    contents_.assign(base::kMaxBlockVariants, BlockContent());
    for (uint32_t variant = 0; variant < base::kMaxBlockVariants; ++variant) {
        const SnapshotGroup* const group = groups.content(variant); // inner types have lower numbers
        if (!group)
            continue;
        BlockContent& content = contents_[variant];
        content = groups.isBlocks(*group) ? sumOfBlocks(*group) : sumOfBalls(*group);
        content.group = group;
        const base::Bounds& bounds = group->info().bounds;
        content.radius = bounds.empty() ? 0.0f : bounds.max.x; // a ball about the origin
        content.identity = identityOf(*group, variant, content);
    }
}

void BlockContents::balls(uint32_t variant, std::pmr::vector<BlockBall>& out) const
{
    struct Level
    {
        base::BlockFrame frame;
        const SnapshotGroup* group = nullptr;
        uint32_t row = 0;
    };
    std::array<Level, base::kMaxBlockLevels + 1> stack;
    size_t depth = 0;
    if (contents_[variant].group)
        stack[depth++].group = contents_[variant].group;
    while (depth > 0) {
        Level& top = stack[depth - 1];
        if (groups_->isBlocks(*top.group)) {
            if (top.row == top.group->count()) {
                --depth;
                continue;
            }
            const uint32_t row = top.row++;
            if (const SnapshotGroup* const inner = groups_->contentOf(*top.group, row);
                inner && depth < stack.size())
                stack[depth++] = {top.frame.inside(*top.group, row), inner, 0};
            continue;
        }
        const float section = top.frame.density * top.frame.scale * top.frame.scale;
        for (uint32_t i = 0; i < top.group->count(); ++i) {
            const glm::vec3 albedo = vectorAt(*top.group, blob::AlbedoR, i);
            const glm::vec3 center =
                top.frame.position + top.frame.turned(vectorAt(*top.group, blob::PositionX, i));
            out.push_back({{center, top.frame.scale * top.group->start(blob::Radius)[i]},
                           {albedo, section * top.group->start(blob::CrossSection)[i]},
                           {lightOf(*top.group, i, albedo), 0.0f}});
        }
        --depth;
    }
}

} // namespace fx::render
