// An OpenGL context without a window for recordings of calls.
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "tests/fuzz/calls_player.h"

#include <memory_resource>

namespace fx::fuzz {

namespace {

constexpr int kSize = 32; ///< [pixel]

struct OwnGl
{
    std::unique_ptr<render::GlContext> context;
    std::unique_ptr<render::GlDevice> device;
    render::GlTexture color, depth;
    GlHost host;
};

template <class T>
T taken(base::Result<T> result)
{
    require(result.ok(), "the machine has OpenGL", result.ok() ? "" : result.status().message());
    return std::move(*result);
}

OwnGl makeGl()
{
    OwnGl own;
    own.context = taken(render::createEglContext({}));
    own.device = taken(render::GlDevice::create(own.context->loader(), std::pmr::get_default_resource()));
    own.color = taken(render::GlTexture::create(*own.device, kSize, kSize, GL_RGBA32F, "host"));
    own.depth = taken(render::GlTexture::create(*own.device, kSize, kSize, GL_DEPTH_COMPONENT32F, "host"));
    const float far = 1.0f;
    own.device->gl.ClearTexImage(own.depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
    const render::GlLoader loader = own.context->loader();
    own.host = {{loader.user, loader.getProcAddress}, own.color.name(), own.depth.name(), kSize};
    return own;
}

} // namespace

const GlHost& glHost()
{
    static const OwnGl own = makeGl();
    return own.host;
}

} // namespace fx::fuzz
