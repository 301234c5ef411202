/// @file backend.h
/// Interface of passes to a graphics system: draws and dispatches, each with its complete state.
///
/// No state persists between calls, so passes cannot depend on the state of other passes, and all changes of
/// GL state are in one place (rendering/gl/gl_backend.cpp). Two backends exist: OpenGL, and a recording one
/// for tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace fx::render {

enum class Format : uint8_t
{
    RGBA32F,
    RGBA16F,
    RGBA8,
    RG32F,
    R32F,
    R32UI,
    RG32UI,
    Depth32F, ///< a depth target
};

constexpr size_t formatBytes(Format format)
{
    switch (format) {
    case Format::RGBA32F:
        return 16;
    case Format::RGBA16F:
        return 8;
    case Format::RGBA8:
        return 4;
    case Format::RG32F:
    case Format::RG32UI:
        return 8;
    case Format::R32F:
        return 4;
    case Format::R32UI:
    case Format::Depth32F:
        return 4;
    }
    return 0;
}

/// A texture or a buffer of the frame graph, in one of its versions. Obtained from FrameGraph.
struct ResourceId
{
    uint32_t index = ~0u;
    bool valid() const { return index != ~0u; }
};

/// One program: names of embedded sources (shaders/) and the permutation's macro definitions. Instances
/// are constants with static storage. Those of the frame's own passes are listed in
/// rendering/passes/programs.cpp, those of a technique by its DrawTechnique::programs, so that all
/// permutations are known beforehand.
struct ProgramDesc
{
    const char* name;
    const char* vertex;   ///< null for compute
    const char* fragment; ///< null for compute
    const char* compute;  ///< null for drawing
    const char* defines;  ///< "FX_FORM=2\nFX_LAYERS=1" or null
};

enum class Blend : uint8_t
{
    None,          ///< source replaces
    Premultiplied, ///< source + (1 - source alpha) * destination, color and alpha, every target
    Additive,      ///< source + destination
};

enum class Sampling : uint8_t
{
    Nearest, ///< clamped to the edge
    Linear,  ///< clamped to the edge
    LinearRepeat,
    Trilinear, ///< between the levels of a texture as well; clamped to the edge
    TrilinearRepeat,
};

struct TextureBinding
{
    uint32_t unit;
    ResourceId texture;
    Sampling sampling = Sampling::Nearest;
};

struct ImageBinding
{
    uint32_t unit;
    ResourceId texture; ///< written by a compute program
};

struct BufferBinding
{
    uint32_t binding;
    ResourceId buffer;
    uint64_t offset = 0;    ///< [byte] a multiple of the context's alignment for storage buffers
    uint64_t bytes = 0;     ///< 0: up to the end
    bool isUniform = false; ///< a std140 block at uniform binding 1 instead of a storage buffer
};

/// One draw of `vertices` x `instances` without vertex attributes (the shader fetches), triangles.
struct DrawCall
{
    const ProgramDesc* program = nullptr;
    /// Color targets, all of one size, which is the viewport; what the program writes to an invalid one is
    /// lost.
    std::span<const ResourceId> targets = {};
    std::span<const TextureBinding> textures = {};
    std::span<const BufferBinding> buffers = {};
    std::span<const std::byte> uniforms = {}; ///< std140 block at uniform binding 0
    Blend blend = Blend::None;
    uint32_t vertices = 3;
    uint32_t instances = 1;
    ResourceId depthTarget = {}; ///< depth texture; tested and written when valid
    bool reversedDepth = false;  ///< depth test GREATER instead of LESS
    /// Indirect draw arguments: a buffer that begins with vertices, instances, 0, 0 as 32-bit words and
    /// replaces the numbers above. Written by a dispatch.
    ResourceId indirect = {};
};

struct DispatchCall
{
    const ProgramDesc* program = nullptr;
    std::span<const TextureBinding> textures = {};
    std::span<const ImageBinding> images = {};
    std::span<const BufferBinding> buffers = {};
    std::span<const std::byte> uniforms = {};
    uint32_t groups[3] = {1, 1, 1};
};

/// Sequence of operations inside a pass. Data given in spans is copied before the call returns.
class Backend
{
public:
    virtual ~Backend() = default;

    virtual void beginPass(std::string_view name) = 0; ///< opens a debug group of this name
    virtual void endPass() = 0;

    virtual void clear(ResourceId texture, const float (&rgba)[4]) = 0;
    virtual void draw(const DrawCall& call) = 0;
    /// Makes earlier writes visible, runs, and makes its own writes visible to later operations.
    virtual void dispatch(const DispatchCall& call) = 0;
    virtual void upload(ResourceId buffer, std::span<const std::byte> bytes) = 0;
    virtual void copyTexture(ResourceId source, ResourceId destination) = 0; ///< same size and format

    virtual int width(ResourceId texture) const = 0;
    virtual int height(ResourceId texture) const = 0;
};

/// Uniform bytes of a trivially copyable struct with std140 layout.
template <class T>
std::span<const std::byte> asUniforms(const T& block)
{
    return std::as_bytes(std::span<const T, 1>(&block, 1));
}

} // namespace fx::render
