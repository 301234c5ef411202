/// @file backend.h
/// Interface between passes and a graphics API. Each draw and each dispatch specifies its complete state.
///
/// No state persists between calls, so passes cannot depend on the state of other passes. Only
/// rendering/gl/gl_backend.cpp changes GL state. There are two backends: a backend for OpenGL, and a
/// recording backend for tests.
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
    RGBA32UI,
    Depth32F, ///< a depth target
};

constexpr size_t formatBytes(Format format)
{
    switch (format) {
    case Format::RGBA32F:
    case Format::RGBA32UI:
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

/// Id of one version of a texture or buffer in the frame graph.
struct ResourceId
{
    uint32_t index = ~0u;
    bool valid() const { return index != ~0u; }
};

/// Description of one shader program: names of the embedded sources (shaders/) and macro definitions of one
/// permutation. Descriptions are constants with static storage. To compile all permutations in advance,
/// rendering/passes/programs.cpp lists the programs of the frame, and DrawTechnique::programs lists the
/// programs of a technique.
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
    None, ///< the source replaces the destination
    /// Result = source + (1 - source alpha) * destination, for color and alpha of every target.
    Premultiplied,
    Additive, ///< source + destination
};

enum class Sampling : uint8_t
{
    Nearest, ///< clamped to the edge
    Linear,  ///< clamped to the edge
    LinearRepeat,
    Trilinear, ///< linear filter, also between mip levels; coordinates are clamped to the edge
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
    ResourceId texture; ///< texture that a compute program writes
};

struct BufferBinding
{
    uint32_t binding;
    ResourceId buffer;
    uint64_t offset = 0;    ///< [byte] begin of the range; a multiple of GlLimits::storageAlignment
    uint64_t bytes = 0;     ///< [byte] size of the range; 0: up to the end of the buffer
    bool isUniform = false; ///< true: a std140 block at uniform binding 1; false: a storage buffer
};

/// One draw of triangles: `vertices` x `instances`, without vertex attributes. The shader fetches its data.
struct DrawCall
{
    const ProgramDesc* program = nullptr;
    /// Color targets. All targets and the viewport have the same size. Output to an invalid target is
    /// discarded.
    std::span<const ResourceId> targets = {};
    std::span<const TextureBinding> textures = {};
    std::span<const BufferBinding> buffers = {};
    std::span<const std::byte> uniforms = {}; ///< data of the std140 block at uniform binding 0
    Blend blend = Blend::None;
    uint32_t vertices = 3;
    uint32_t instances = 1;
    ResourceId depthTarget = {}; ///< depth texture; if it is valid, depth is tested and written
    bool reversedDepth = false;  ///< true: the depth test is GREATER; false: LESS
    /// Buffer with indirect draw arguments, which a dispatch has written. The buffer begins with vertices,
    /// instances, 0, 0 as 32-bit words. If valid, `indirect` replaces the members `vertices` and
    /// `instances`.
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

/// Executes the operations of a pass. The data of spans are copied before a call returns.
class Backend
{
public:
    virtual ~Backend() = default;

    virtual void beginPass(std::string_view name) = 0; ///< opens a debug group with this name
    virtual void endPass() = 0;

    virtual void clear(ResourceId texture, const float (&rgba)[4]) = 0;
    virtual void draw(const DrawCall& call) = 0;
    /// Runs a compute program. The program sees all earlier writes. Later operations see the writes of the
    /// program.
    virtual void dispatch(const DispatchCall& call) = 0;
    virtual void upload(ResourceId buffer, std::span<const std::byte> bytes) = 0;
    /// Both textures must have the same size and format.
    virtual void copyTexture(ResourceId source, ResourceId destination) = 0;

    virtual int width(ResourceId texture) const = 0;
    virtual int height(ResourceId texture) const = 0;
};

/// Returns the bytes of a trivially copyable struct with std140 layout.
template <class T>
std::span<const std::byte> asUniforms(const T& block)
{
    return std::as_bytes(std::span<const T, 1>(&block, 1));
}

} // namespace fx::render
