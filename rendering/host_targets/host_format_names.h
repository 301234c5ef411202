/// @file host_format_names.h
/// Names of OpenGL's enumerants, for messages about textures of the host.
#pragma once

#include <GL/glcorearb.h>

#include <string>

namespace fx::render {

std::string glFormatName(GLenum internalFormat); ///< "GL_RGBA8UI"; a number where it is not known
std::string glTargetName(GLenum target);         ///< "GL_TEXTURE_2D_MULTISAMPLE"; a number otherwise

} // namespace fx::render
