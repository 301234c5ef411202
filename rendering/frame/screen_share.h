/// @file screen_share.h
/// How much of a picture techniques cover: what an error in them matters.
#pragma once

namespace fx::render {

/// Shares of the picture, [0, 1).
struct ScreenShare
{
    double media = 0; ///< covered by blobs
    double hot = 0;   ///< covered by blobs with heat
};

} // namespace fx::render
