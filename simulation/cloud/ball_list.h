/// @file ball_list.h
/// Balls of a medium that does not move, from files.
///
/// A file `*.fxballs` is a text header followed by binary numbers:
///     fxballs 1
///     count N             1..2^20
///     data                followed by a line feed
///     N * 12 binary32 numbers, little endian, one ball after another: x y z [m], radius [m], cross section
///     [m2], temperature [K], albedo r g b, emission r g b [cd/m2]
/// The lines of the header have this order. Each ends with a line feed; spaces separate their words.
#pragma once

#include "foundation/result/status.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fx::sim {

constexpr size_t kMaxListedBalls = size_t(1) << 20;
constexpr uint64_t kMaxBallListBytes = uint64_t(kMaxListedBalls) * 48 + 64; ///< [byte] maximum size of a file

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

/// Reads a file. @return Parse with the byte, Version, TooLarge, InvalidArgument with the number of the ball
base::Result<std::shared_ptr<const BallList>> parseBallList(std::string_view bytes);

/// The file of a list; the inverse of parseBallList().
std::string writeBallList(const BallList& balls);

} // namespace fx::sim
