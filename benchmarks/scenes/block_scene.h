/// @file block_scene.h
/// A scene for measurements of blocks: equal blocks of many small balls, spread over half of the picture.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/scene_file/scene_file.h"

#include <cstdint>
#include <optional>

namespace fx::cli {

/// Number and size of the blocks of a BlockScene.
struct BlockSceneSize
{
    uint32_t blocks = 2000;
    uint32_t ballsPerBlock = 512;
    float pixels = 24.0f; ///< [pixel] median diameter of a block on a picture of `height`
    int width = 640, height = 360;
    bool isMoving = false; ///< true: blocks consist of an emitter's particles, in a loop
};

/// Part of the picture, from 0 to 1 in x and y.
struct PictureCrop
{
    float x, y, size;
};

/// A scene with one effect and a camera in front of it, in sunlight from the side.
/// @param crop only blocks that may be seen there; empty: all
base::Result<scene_file::SceneFile> blockScene(const BlockSceneSize& size,
                                               const std::optional<PictureCrop>& crop = {});

} // namespace fx::cli
