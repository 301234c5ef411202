// Lists of voxels in textures: the texel of each element, read back.
#include "view_fixture.h"

#include "rendering/compositions/voxel_texture.h"

#include <cstdint>
#include <vector>

using namespace fx;

namespace {

class VoxelTextureTest : public test::ViewTest
{
protected:
    using Packed = base::VolumeLevel::Packed;

    static std::vector<Packed> listOf(size_t count)
    {
        std::vector<Packed> list(count);
        for (uint32_t i = 0; i < count; ++i)
            list[i] = {i, ~i, 3 * i, i * i};
        return list;
    }

    /// All texels, those that hold nothing, too.
    std::vector<Packed> texelsOf(const render::GlTexture& texture)
    {
        std::vector<Packed> texels(size_t(texture.width()) * size_t(texture.height()) *
                                   size_t(texture.depth()));
        device_->gl.GetTextureImage(texture.name(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                                    GLsizei(texels.size() * sizeof(Packed)), texels.data());
        return texels;
    }
};

} // namespace

/// Rows of 512 texels and layers of 512 rows follow each other, as the shader counts them.
TEST_F(VoxelTextureTest, holdsListsOfAllSizesInOrder)
{
    constexpr size_t kRow = 512, kLayer = 512 * 512;
    for (const size_t count : {size_t(1), kRow, 3 * kRow + 256, kLayer, kLayer + 256, 2 * kLayer + 5 * kRow,
                               2 * kLayer + 5 * kRow + 256})
    {
        const std::vector<Packed> list = listOf(count);
        const auto texture = render::makeVoxelTexture(*device_, list, "voxels");
        ASSERT_TRUE(texture) << texture.status().message();
        EXPECT_EQ(texture->width(), int(kRow));
        EXPECT_TRUE(texture->depth() == 1 || texture->height() == int(kRow));
        std::vector<Packed> texels = texelsOf(*texture);
        ASSERT_GE(texels.size(), count);
        EXPECT_LT(texels.size(), count + (texture->depth() > 1 ? kLayer : kRow));
        texels.resize(count);
        EXPECT_EQ(texels, list) << count;
    }
}

TEST_F(VoxelTextureTest, areNotReadAsTheHostReadsItsOwn)
{
    device_->gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 700);
    device_->gl.PixelStorei(GL_UNPACK_SKIP_ROWS, 3);
    const std::vector<Packed> list = listOf(1024);
    const auto texture = render::makeVoxelTexture(*device_, list, "voxels");
    GLint length = 0;
    device_->gl.GetIntegerv(GL_UNPACK_ROW_LENGTH, &length);
    EXPECT_EQ(length, 700);
    device_->gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    device_->gl.PixelStorei(GL_UNPACK_SKIP_ROWS, 0);
    ASSERT_TRUE(texture) << texture.status().message();
    EXPECT_EQ(texelsOf(*texture), list);
}
