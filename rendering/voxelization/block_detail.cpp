#include "rendering/voxelization/block_detail.h"

#include "rendering/optics/color_temperature.h"
#include "rendering/voxelization/ball_weights.h"

#include <memory>

namespace fx::render {

std::pair<double, double> DetailedBall::light(size_t voxel) const
{
    const float change = factors[voxel].temperature;
    const double now = change == 1.0f ? 1.0 : detail.luminance(index, change) / ball.luminance;
    return {now, now * double(blackBodyColor(float(ball.temperature) * change).x)};
}

void BlockDetail::find(const BlockPlan::Block& block, std::span<const uint32_t> list,
                       std::span<const VoxelBall> balls, std::span<const double> normalization)
{
    if (!detail_)
        return;
    count_ = 0;
    const auto weights = std::make_unique<BallWeights>();
    for (const uint32_t ball : list) {
        const int32_t own = detail_->groupOf(ball);
        if (own < 0 || !weights->assign(balls[ball], voxelSize_, block.origin, nullptr))
            continue;
        Group* const known = find(size_t(own));
        Group& group = known ? *known : add(size_t(own));
        const VoxelDetail::Values values = detail_->valuesOf(ball);
        const double density = densityOf(balls[ball], normalization[ball], voxelSize_);
        forVoxels(*weights, false, [&](size_t v, double weight) {
            group.extinction[v] += density * weight;
            for (size_t k = 0; k < values.size(); ++k)
                group.values[v][k] += density * weight * values[k];
        });
    }
    for (size_t g = 0; g < count_; ++g)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v)
            if (const double extinction = groups_[g]->extinction[v]; extinction > 0.0) {
                VoxelDetail::Values means = groups_[g]->values[v];
                for (double& mean : means)
                    mean /= extinction;
                const glm::ivec3 at = block.origin + glm::ivec3(int(v >> 6), int(v >> 3 & 7), int(v & 7));
                groups_[g]->factors[v] =
                    detail_->at(groups_[g]->number, extinction, means, voxelSize_ * glm::dvec3(at));
            }
}

/// A group of the last block; null: no ball of it reaches the block.
BlockDetail::Group* BlockDetail::find(size_t number)
{
    for (size_t g = 0; g < count_; ++g)
        if (groups_[g]->number == number)
            return groups_[g].get();
    return nullptr;
}

BlockDetail::Group& BlockDetail::add(size_t number)
{
    if (count_ == groups_.size())
        groups_.push_back(std::make_unique<Group>());
    Group& group = *groups_[count_++];
    group.number = number;
    group.extinction.fill(0.0);
    group.values.fill({});
    group.factors.fill({});
    return group;
}

const DetailedBall* BlockDetail::of(uint32_t index, const VoxelBall& ball)
{
    const int32_t own = detail_ ? detail_->groupOf(index) : -1;
    const Group* const group = own < 0 ? nullptr : find(size_t(own));
    return group ? &ball_.emplace(DetailedBall{*detail_, group->factors, index, ball}) : nullptr;
}

} // namespace fx::render
