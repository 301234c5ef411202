#include "rendering/voxelization/small_balls.h"

#include <cstddef>

namespace fx::render {

std::vector<VoxelBall> joinStreaks(std::span<const VoxelBall> balls)
{
    std::vector<VoxelBall> joined;
    for (size_t first = 0; first < balls.size();) {
        size_t end = first + 1;
        while (end < balls.size() && balls[end].id == balls[first].id &&
               balls[end].instance == balls[first].instance)
            ++end;
        VoxelBall& ball = joined.emplace_back(balls[first]); // the foremost piece
        for (size_t i = first + 1; i < end; ++i)
            ball.crossSection += balls[i].crossSection;
        const auto pieces = double(end - first);
        if (pieces > 1.0) // piece k is k / pieces of the way behind
            ball.streak = (balls[first].center - balls[end - 1].center) * (pieces / (pieces - 1.0));
        first = end;
    }
    return joined;
}

} // namespace fx::render
