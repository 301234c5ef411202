#include "rendering/gl/gl_functions.h"

#include <string>

namespace fx::render {

base::Status GlFunctions::load(const GlLoader& loader)
{
    if (!loader.getProcAddress)
        return {base::Code::InvalidArgument, "getProcAddress is null: OpenGL functions cannot be found"};

    constexpr int kMostNamed = 4;
    std::string missing;
    int count = 0;
#define FX_GL(type, name)                                                                                    \
    if (!name.load(loader, "gl" #name, monitor) && ++count <= kMostNamed)                                    \
        missing += missing.empty() ? "gl" #name : ", gl" #name;
#include "rendering/gl/gl_functions.inl"
#undef FX_GL

    if (missing.empty())
        return {};
    if (count > kMostNamed)
        missing += " and " + std::to_string(count - kMostNamed) + " more functions";
    return {base::Code::GlUnsupported,
            "getProcAddress does not find " + missing + "; a current OpenGL 4.5 core context is needed"};
}

} // namespace fx::render
