/// @file gl_name.h
/// Owners of GL objects that need no data besides a name: vertex arrays, samplers, framebuffers.
#pragma once

#include "rendering/gl/gl_device.h"

#include <cstdint>
#include <utility>

namespace fx::render {

/// Owner of a GL object. The destructor deletes the object; the context must be current then. `Delete` is
/// the pointer to a glDelete... member of GlFunctions.
template <auto Delete>
class GlName
{
public:
    GlName() = default;
    GlName(GlDevice& device, uint32_t name) : device_(&device), name_(name) {}
    ~GlName()
    {
        if (name_)
            (device_->gl.*Delete)(1, &name_);
    }
    GlName(GlName&& other) noexcept : device_(other.device_), name_(std::exchange(other.name_, 0)) {}
    GlName& operator=(GlName&& other) noexcept
    {
        std::swap(device_, other.device_);
        std::swap(name_, other.name_);
        return *this;
    }

    uint32_t name() const { return name_; }

private:
    GlDevice* device_ = nullptr;
    uint32_t name_ = 0;
};

using GlVertexArray = GlName<&GlFunctions::DeleteVertexArrays>;
using GlSampler = GlName<&GlFunctions::DeleteSamplers>;
using GlFramebuffer = GlName<&GlFunctions::DeleteFramebuffers>;

GlVertexArray createVertexArray(GlDevice& device);
GlFramebuffer createFramebuffer(GlDevice& device);
GlSampler createSampler(GlDevice& device, Sampling sampling);

} // namespace fx::render
