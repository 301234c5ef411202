#include "rendering/view/layer_grid.h"

#include "rendering/frame/ball_window.h"

#include <cmath>

namespace fx::render {

namespace {

/// The camera of a window that begins where the picture begins and is `stretchX`, `stretchY` times as large.
CameraView stretched(const CameraView& camera, float stretchX, float stretchY)
{
    CameraView wider = camera;
    const float scale[2] = {1.0f / stretchX, 1.0f / stretchY};
    // Window y grows against clip y when the origin is at the top.
    const float origin[2] = {-1.0f, camera.upperLeftOrigin ? 1.0f : -1.0f};
    for (int column = 0; column < 4; ++column)
        for (int axis = 0; axis < 2; ++axis)
            wider.projection[column][axis] =
                camera.projection[column][axis] * scale[axis] +
                origin[axis] * (1.0f - scale[axis]) * camera.projection[column][3];
    return wider;
}

} // namespace

LayerGrid makeLayerGrid(const CameraView& camera, int width, int height, int divisor)
{
    LayerGrid grid{divisor, (width + divisor - 1) / divisor, (height + divisor - 1) / divisor, {}};
    const float stretchX = float(grid.width * divisor) / float(width);
    const float stretchY = float(grid.height * divisor) / float(height);
    const bool fits = stretchX == 1.0f && stretchY == 1.0f;
    grid.view = makeViewBlock(fits ? camera : stretched(camera, stretchX, stretchY), grid.width, grid.height);
    if (divisor > 1)
        grid.view.pass.x = kMinPixels / (0.5f * float(grid.height) * std::abs(grid.view.up.w));
    return grid;
}

} // namespace fx::render
