/// @file ball_list.h
/// Balls of medium from files: a medium that does not move, or a frame of one that does.
///
/// A file `*.fxballs` is a text header followed by binary numbers:
///     fxballs 1
///     count N             1..2^20
///     data                followed by a line feed
///     N * 12 binary32 numbers, little endian, one ball after another: x y z [m], radius [m], cross section
///     [m2], temperature [K], albedo r g b, emission r g b [cd/m2]
/// A frame of a sequence has `fxballs 2` and N from 0. Behind the 12 numbers of a ball are 8 more, velocity x
/// y z [m/s], streak x y z [m], age [s] and rate of the emission [1/s], and its number as a 64-bit integer,
/// little endian; numbers rise from ball to ball. The lines of the header have this order. Each ends with a
/// line feed; spaces separate their words.
#pragma once

#include "foundation/result/status.h"
#include "foundation/snapshot/block_kind.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fx::sim {

/// [s] Age of a ball that has no birth, or of which it is not known.
constexpr float kUnknownAge = base::kSettledAge;
constexpr size_t kMaxListedBalls = size_t(1) << 20;
constexpr uint64_t kMaxBallListBytes = uint64_t(kMaxListedBalls) * 88 + 64; ///< [byte] maximum size of a file

/// One ball with the kernel of foundation/snapshot/blob_kind.h.
struct ListedBall
{
    glm::vec3 center{0.0f};     ///< [m] at most 1e6
    float radius = 1.0f;        ///< [m] 1e-6 to 1e6
    float crossSection = 0.0f;  ///< [m2] 0 to 1e12: integral of the extinction over space
    float temperature = 293.0f; ///< [K] 0 to 1e5; the ball glows as a gray body
    glm::vec3 albedo{0.0f};     ///< [1] 0 to 1
    glm::vec3 emission{0.0f};   ///< [cd/m2] 0 to 1e12: luminance of the opaque medium besides the black body
};

using BallList = std::vector<ListedBall>;

/// One ball of a frame.
struct MovingBall
{
    ListedBall ball;
    glm::vec3 velocity{0.0f}; ///< [m/s] components within 1e9
    glm::vec3 streak{0.0f};   ///< [m] way of the ball while the shutter is open, components within 1e6
    float age = kUnknownAge;  ///< [s] since its birth, 0 to kUnknownAge
    float rate = 0.0f;   ///< [1/s] change of the logarithm of its emission, within 1e6; 0 also: not known
    uint64_t number = 0; ///< the same in all frames that show the ball
};

using MovingBalls = std::vector<MovingBall>; ///< rising by their numbers

/// Reads a file. @return Parse with the byte, Version, TooLarge, InvalidArgument with the number of the ball
base::Result<std::shared_ptr<const BallList>> parseBallList(std::string_view bytes);

/// The file of a list; the inverse of parseBallList().
std::string writeBallList(const BallList& balls);

/// Reads a frame of a sequence; errors as those of parseBallList().
base::Result<std::shared_ptr<const MovingBalls>> parseMovingBalls(std::string_view bytes);

/// The inverse of parseMovingBalls().
std::string writeMovingBalls(const MovingBalls& balls);

} // namespace fx::sim
