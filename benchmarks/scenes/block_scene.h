/// @file block_scene.h
/// A scene for measurements of blocks: equal blocks of many small balls, spread over half of the picture.
#pragma once

#include "benchmarks/scenes/picture_window.h"
#include "foundation/result/status.h"
#include "fxsdk/scene_file/scene_file.h"

#include <cstdint>
#include <optional>

namespace fx::cli {

/// Number and size of the blocks of a BlockScene.
struct BlockSceneSize
{
    uint32_t blocks = 2000;
    uint32_t partsPerBlock = 1; ///< above 1, blocks consist of so many blocks of balls
    uint32_t ballsPerPart = 512;
    float pixels = 24.0f; ///< [pixel] median diameter of a block on a picture of `height`
    int width = 640, height = 360;
    bool isMoving = false; ///< true: blocks consist of an emitter's particles, in a loop

    uint32_t ballsPerBlock() const { return partsPerBlock * ballsPerPart; }
};

/// A scene with one effect and a camera in front of it, in sunlight from the side.
/// @param window in blocks that cannot be seen there, one ball stands for each part, as large as the part and
/// of its cross section: it casts the shadow that impostors cast where there are many balls. Not for blocks
/// that move. Empty: all blocks are complete
base::Result<scene_file::SceneFile> blockScene(const BlockSceneSize& size,
                                               const std::optional<PictureWindow>& window = {});

} // namespace fx::cli
