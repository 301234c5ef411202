#include "rendering/compositions/voxel_texture.h"

#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_unpack_scope.h"

#include <algorithm>

namespace fx::render {

namespace {

/// Equal to the shifts of wordsOf() in shaders/field/field_volume.comp.glsl.
constexpr size_t kColumns = 512, kRows = 512;
/// With velocities a brick has three halves of an element a voxel; coarser voxels reach into 8 times the
/// bricks.
static_assert(8 * base::kMaxVolumeBricks * base::kVolumeBrickVoxels * 3 / 2 <= 2048 * kColumns * kRows);

/// Number of boxes of `size` elements that hold `count`.
size_t boxesOf(size_t count, size_t size)
{
    return (count + size - 1) / size;
}

} // namespace

base::Result<GlTexture> makeVoxelTexture(GlDevice& device, std::span<const base::VolumeLevel::Packed> list,
                                         const char* label)
{
    const size_t rows = boxesOf(list.size(), kColumns);
    base::Result<GlTexture> made = GlTexture::createVolume(device, int(kColumns), int(std::min(rows, kRows)),
                                                           int(boxesOf(rows, kRows)), GL_RGBA32UI, label);
    if (!made)
        return made;
    const GlUnpackScope unpack(device.gl);
    size_t done = 0;
    // as many layers, then rows, then elements as are full
    for (const size_t size : {kColumns * kRows, kColumns, size_t(1)}) {
        const size_t count = (list.size() - done) / size;
        if (count == 0)
            continue;
        const size_t row = done / kColumns;
        device.gl.TextureSubImage3D(made->name(), 0, 0, GLint(row % kRows), GLint(row / kRows),
                                    GLsizei(std::min(count * size, kColumns)),
                                    GLsizei(size < kColumns ? 1 : std::min(count * size / kColumns, kRows)),
                                    GLsizei(size < kColumns * kRows ? 1 : count), GL_RGBA_INTEGER,
                                    GL_UNSIGNED_INT, list.data() + done);
        done += count * size;
    }
    if (base::Status status = device.takeError(label); !status)
        return status;
    return made;
}

} // namespace fx::render
