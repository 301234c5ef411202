#include "foundation/snapshot/block_groups.h"

#include <algorithm>

namespace fx::base {

namespace {

namespace block = block_column;

/// Variant that a group is the content of; kNoOwner for the blocks of the effect.
float variantOfGroup(const SnapshotGroup& group, bool isBalls)
{
    return group.constants()[isBalls ? size_t(block_ball_constant::Variant) : size_t(block_constant::Owner)];
}

} // namespace

BlockFrame BlockFrame::inside(const SnapshotGroup& blocks, uint32_t i) const
{
    const auto value = [&](size_t column) { return blocks.start(column)[i]; };
    BlockFrame inner;
    inner.position = position + turned(vectorAt(blocks, block::PositionX, i));
    inner.velocity = velocity + turned(vectorAt(blocks, block::VelocityX, i));
    inner.rotation = rotation * glm::quat(value(block::RotationW), value(block::RotationX),
                                          value(block::RotationY), value(block::RotationZ));
    inner.scale = scale * value(block::Scale);
    inner.density = density * value(block::Density);
    inner.age = std::min(age, value(block::Age));
    inner.id = id + blocks.ids()[i];
    return inner;
}

BlockGroups::BlockGroups(const FrameSnapshot& snapshot, size_t end)
    : snapshot_(snapshot), balls_(snapshot.schema().find(kBlockBallKind.name)), root_(end - 1)
{
    places_.fill(kAbsent);
    for (; root_ > 0; --root_) {
        const SnapshotGroup& group = snapshot.added(root_);
        const float variant = variantOfGroup(group, group.info().kind == balls_);
        if (variant == kNoOwner)
            break;
        places_[size_t(variant)] = uint32_t(root_);
    }
    leaveOutEmpty(end);
}

const SnapshotGroup* BlockGroups::material() const
{
    if (root_ == 0)
        return nullptr;
    const SnapshotGroup& before = snapshot_.added(root_ - 1);
    const GroupInfo &info = before.info(), &own = root().info();
    const bool isOwn = snapshot_.schema().kind(info.kind) == kBlockMaterialKind &&
                       info.instance == own.instance && info.solver == own.solver;
    return isOwn ? &before : nullptr;
}

/// Removes the variants without any ball, so that a walk through blocks ends with the balls. What a block
/// consists of comes before it.
void BlockGroups::leaveOutEmpty(size_t end)
{
    for (size_t place = root_ + 1; place < end; ++place) {
        const SnapshotGroup& group = snapshot_.added(place);
        const bool isBalls = group.info().kind == balls_;
        bool isEmpty = group.count() == 0;
        for (uint32_t i = 0; !isBalls && !isEmpty; ++i) {
            if (i == group.count())
                isEmpty = true;
            else if (contentOf(group, i))
                break;
        }
        if (isEmpty)
            places_[size_t(variantOfGroup(group, isBalls))] = kAbsent;
    }
}

} // namespace fx::base
