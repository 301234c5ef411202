#include "state_cache.h"

void StateCache::setSwitch(std::optional<bool>& known, GLenum what, bool isOn)
{
    if (!changes(known, isOn))
        return;
    if (isOn)
        glEnable(what);
    else
        glDisable(what);
}

void StateCache::useProgram(GLuint program)
{
    if (changes(program_, program))
        glUseProgram(program);
}

void StateCache::bindVertexArray(GLuint array)
{
    if (changes(vertexArray_, array))
        glBindVertexArray(array);
}

void StateCache::bindFramebuffer(GLuint framebuffer)
{
    if (changes(framebuffer_, framebuffer))
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
}

void StateCache::bindTexture(GLuint unit, GLuint texture)
{
    if (changes(textures_[unit], texture))
        glBindTextureUnit(unit, texture);
}

void StateCache::setDepth(bool test, bool write, GLenum function)
{
    setSwitch(depthTest_, GL_DEPTH_TEST, test);
    if (changes(depthWrite_, write))
        glDepthMask(write ? GL_TRUE : GL_FALSE);
    if (changes(depthFunction_, function))
        glDepthFunc(function);
}

void StateCache::setBlend(bool isOn)
{
    setSwitch(blend_, GL_BLEND, isOn);
}

void StateCache::setCull(bool isOn)
{
    setSwitch(cull_, GL_CULL_FACE, isOn);
}

void StateCache::setViewport(const Rectangle& viewport)
{
    if (changes(viewport_, viewport))
        glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
}

int StateCache::countFalse() const
{
    int count = 0;
    const auto compare = [&count](const auto& known, GLenum name) {
        GLint value = 0;
        glGetIntegerv(name, &value);
        count += known && GLint(*known) != value ? 1 : 0;
    };
    compare(program_, GL_CURRENT_PROGRAM);
    compare(vertexArray_, GL_VERTEX_ARRAY_BINDING);
    compare(framebuffer_, GL_DRAW_FRAMEBUFFER_BINDING);
    compare(depthTest_, GL_DEPTH_TEST);
    compare(depthWrite_, GL_DEPTH_WRITEMASK);
    compare(depthFunction_, GL_DEPTH_FUNC);
    compare(blend_, GL_BLEND);
    compare(cull_, GL_CULL_FACE);
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint unit = 0; unit < kUnits; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        compare(textures_[unit], GL_TEXTURE_BINDING_2D);
    }
    glActiveTexture(GLenum(active));
    Rectangle viewport;
    glGetIntegerv(GL_VIEWPORT, &viewport.x);
    return count + (viewport_ && *viewport_ != viewport ? 1 : 0);
}
