/// @file screen_share.h
/// Share of the picture that techniques cover, as the weight of their errors.
#pragma once

namespace fx::render {

/// Shares of the picture, [0, 1).
struct ScreenShare
{
    double media = 0; ///< covered by blobs
    double hot = 0;   ///< covered by blobs with heat
};

} // namespace fx::render
