/// @file gl_read_texture.h
/// Functions that copy pictures from the GPU for tools and tests. They wait for the GPU.
#pragma once

#include <cstdint>
#include <vector>

namespace fx::render {

class GlDevice;

/// Reads the first `channels` (1 to 4) channels of each texel as floats, row by row upwards from texture
/// coordinate 0. Normalized formats give [0, 1]. GL's pixel-pack state is restored.
std::vector<float> readTexture(GlDevice& device, uint32_t texture, int width, int height, int channels);

/// Reads the depth values, in [0, 1], of a depth texture. The order of texels is that of readTexture().
std::vector<float> readDepthTexture(GlDevice& device, uint32_t texture, int width, int height);

/// Reads a texture of one or two unsigned channels. The order of texels is that of readTexture().
std::vector<uint32_t> readUintTexture(GlDevice& device, uint32_t texture, int width, int height,
                                      int channels = 1);

/// Reads the first color attachment of a framebuffer, or the window's back buffer for framebuffer 0. Values
/// and their order are as in readTexture().
std::vector<float> readFramebuffer(GlDevice& device, uint32_t framebuffer, int width, int height,
                                   int channels);

} // namespace fx::render
