#include "rendering/host_targets/host_texture.h"

#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_name.h"

#include <algorithm>
#include <iterator>

namespace fx::render {

namespace {

GLint parameter(const GlFunctions& gl, uint32_t texture, GLenum what)
{
    GLint value = 0;
    gl.GetTextureParameteriv(texture, what, &value);
    return value;
}

GLint levelParameter(const GlFunctions& gl, uint32_t texture, GLenum what)
{
    GLint value = 0;
    gl.GetTextureLevelParameteriv(texture, 0, what, &value);
    return value;
}

struct TargetBinding
{
    GLenum target;
    GLenum binding; ///< name of the query of the bound texture
};

constexpr TargetBinding kMultisample = {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE};

/// The targets that messages name; those that frames use are tried first.
constexpr TargetBinding kTargetBindings[] = {
    {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    kMultisample,
    {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
    {GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY},
    {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
    {GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
    {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
    {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    {GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
    {GL_TEXTURE_1D_ARRAY, GL_TEXTURE_BINDING_1D_ARRAY}};

/// A context keeps at most one error of each kind, so that few calls empty it; a lost one always has one.
void forgetErrors(const GlFunctions& gl)
{
    for (int i = 0; i < 8 && gl.GetError() != GL_NO_ERROR; ++i) {
    }
}

std::string targetFault(GLenum target, HostUse use)
{
    const std::string is = "is a " + glTargetName(target);
    switch (target) {
    case GL_TEXTURE_2D:
        return {};
    case GL_TEXTURE_2D_MULTISAMPLE:
        if (use != HostUse::ReadShadow)
            return {};
        [[fallthrough]];
    case GL_TEXTURE_2D_MULTISAMPLE_ARRAY:
        return is + ": resolve it into a GL_TEXTURE_2D (glBlitNamedFramebuffer) and give that";
    case GL_TEXTURE_2D_ARRAY:
    case GL_TEXTURE_CUBE_MAP:
    case GL_TEXTURE_CUBE_MAP_ARRAY:
        return is + ": give a GL_TEXTURE_2D, such as a view of one layer (glTextureView)";
    default:
        return is + ": give a GL_TEXTURE_2D";
    }
}

/// States of the texture object that change what a shader reads; those of filtering and comparison do not, as
/// frames bring samplers of their own.
std::string stateFault(const HostTexture& facts)
{
    if (facts.baseLevel != 0)
        return "has GL_TEXTURE_BASE_LEVEL " + std::to_string(facts.baseLevel) +
               ": set it to 0, or give a view of that level (glTextureView)";
    if (!isDepth(facts.use)) {
        constexpr std::array<GLint, 4> kPlain = {GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA};
        return facts.swizzle == kPlain ? std::string()
                                       : "has a GL_TEXTURE_SWIZZLE_RGBA: set it to red, green, blue, alpha";
    }
    if (facts.swizzle[0] != GL_RED)
        return "has a GL_TEXTURE_SWIZZLE_R: set it to GL_RED";
    return facts.stencilMode == GL_STENCIL_INDEX
               ? "has GL_DEPTH_STENCIL_TEXTURE_MODE GL_STENCIL_INDEX: set it to GL_DEPTH_COMPONENT"
               : std::string();
}

} // namespace

GLint textureTargetOf(const GlDevice& device, uint32_t name)
{
    const GlFunctions& gl = device.gl;
    if (device.limits().tellsTextureTarget)
        return parameter(gl, name, GL_TEXTURE_TARGET);
    forgetErrors(gl);
    const auto binds = [&gl, name](const TargetBinding& tried) {
        GLint bound = 0;
        gl.GetIntegerv(tried.binding, &bound);
        gl.BindTexture(tried.target, name);
        const bool isTarget = gl.GetError() == GL_NO_ERROR;
        gl.BindTexture(tried.target, static_cast<GLuint>(bound));
        return isTarget;
    };
    if (levelParameter(gl, name, GL_TEXTURE_SAMPLES) > 0 && binds(kMultisample))
        return GL_TEXTURE_2D_MULTISAMPLE;
    const TargetBinding* const found = std::ranges::find_if(kTargetBindings, binds);
    return found == std::end(kTargetBindings) ? GL_NONE : static_cast<GLint>(found->target);
}

HostTexture HostTextureCheck::factsOf(uint32_t name, HostUse use) const
{
    const GlFunctions& gl = device_.gl;
    HostTexture facts;
    facts.name = name;
    facts.use = use;
    facts.format = levelParameter(gl, name, GL_TEXTURE_INTERNAL_FORMAT);
    facts.width = levelParameter(gl, name, GL_TEXTURE_WIDTH);
    facts.height = levelParameter(gl, name, GL_TEXTURE_HEIGHT);
    // a buffer has no parameters that could be asked for, not even its target; its height is 1
    const bool isBuffer =
        facts.height == 1 && levelParameter(gl, name, GL_TEXTURE_BUFFER_DATA_STORE_BINDING) != 0;
    facts.target = isBuffer ? GL_TEXTURE_BUFFER : textureTargetOf(device_, name);
    if (facts.target != GL_TEXTURE_2D && !facts.hasSamples())
        return facts;
    facts.baseLevel = parameter(gl, name, GL_TEXTURE_BASE_LEVEL);
    gl.GetTextureParameteriv(name, GL_TEXTURE_SWIZZLE_RGBA, facts.swizzle.data());
    if (isDepth(use))
        facts.stencilMode = parameter(gl, name, GL_DEPTH_STENCIL_TEXTURE_MODE);
    return facts;
}

/// Whether a framebuffer can have it. Which formats can be drawn to is partly up to the driver.
bool HostTextureCheck::isDrawable(uint32_t name) const
{
    const GlFramebuffer framebuffer = createFramebuffer(device_);
    device_.gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, name, 0);
    return device_.gl.CheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER) ==
           GL_FRAMEBUFFER_COMPLETE;
}

std::string HostTextureCheck::formatFault(const HostTexture& facts) const
{
    const auto ask = [&](GLenum what) { return levelParameter(device_.gl, facts.name, what); };
    const bool hasDepth = ask(GL_TEXTURE_DEPTH_TYPE) != GL_NONE;
    const std::string has = "has the format " + glFormatName(static_cast<GLenum>(facts.format)) + ", ";
    const GLint redType = ask(GL_TEXTURE_RED_TYPE);
    const bool hasGreenAndBlue = ask(GL_TEXTURE_GREEN_SIZE) > 0 && ask(GL_TEXTURE_BLUE_SIZE) > 0;
    if (isDepth(facts.use)) {
        const bool isCopy =
            redType == GL_FLOAT && ask(GL_TEXTURE_RED_SIZE) == 32 && ask(GL_TEXTURE_GREEN_SIZE) == 0;
        if (isCopy && facts.hasSamples())
            return has + "whose samples OpenGL would average: use a GL_DEPTH_ format";
        return hasDepth || isCopy ? std::string()
                                  : has + "which holds no depth: use GL_DEPTH_COMPONENT32F or another "
                                          "GL_DEPTH_ format, or GL_R32F with the same values";
    }
    const char* const remedy = ": use GL_RGBA16F";
    if (hasDepth)
        return has + "which holds depth, not color" + remedy;
    if (redType == GL_INT || redType == GL_UNSIGNED_INT)
        return has + "which holds integers, not light" + remedy;
    if (!hasGreenAndBlue)
        return has + "which lacks one of red, green and blue" + remedy;
    if (facts.use == HostUse::DrawColor && (ask(GL_TEXTURE_COMPRESSED) != 0 || !isDrawable(facts.name)))
        return has + "to which this OpenGL cannot draw" + remedy;
    return {};
}

std::string HostTextureCheck::faultOf(const HostTexture& facts) const
{
    if (std::string fault = targetFault(static_cast<GLenum>(facts.target), facts.use); !fault.empty())
        return fault;
    if (facts.width < 1 || facts.height < 1)
        return "has no image at level 0: allocate it (glTextureStorage2D)";
    if (std::string fault = stateFault(facts); !fault.empty())
        return fault;
    return formatFault(facts);
}

base::Status HostTextureCheck::check(uint32_t name, HostUse use, const char* member, HostTexture& outFacts)
{
    const auto refuse = [member](const std::string& fault) {
        return base::Status(base::Code::InvalidArgument, std::string(member) + " " + fault);
    };
    if (!device_.gl.IsTexture(name))
        return refuse("is " + std::to_string(name) +
                      ", which names no texture of this context: give one that has been created or bound and "
                      "is not deleted");
    const HostTexture facts = factsOf(name, use);
    if (std::find(good_.begin(), good_.end(), facts) == good_.end()) {
        if (const std::string fault = faultOf(facts); !fault.empty())
            return refuse(fault);
        good_[next_] = facts;
        next_ = (next_ + 1) % good_.size();
    }
    outFacts = facts;
    return {};
}

} // namespace fx::render
