#include "fxsdk/cli/inspect/doctor.h"

#include <epoxy/egl.h>

#include <array>
#include <cstring>

namespace fx::cli {
namespace {

std::string deviceName(EGLDeviceEXT device)
{
    const char* const extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    if (extensions == nullptr)
        return "unnamed device";
    if (std::strstr(extensions, "EGL_MESA_device_software") != nullptr)
        return "software rasterizer (Mesa)";
    if (std::strstr(extensions, "EGL_EXT_device_drm") != nullptr) {
        const char* const file = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT);
        return file != nullptr ? file : "DRM device";
    }
    return std::strstr(extensions, "EGL_NV_device_cuda") != nullptr ? "NVIDIA device" : "unnamed device";
}

} // namespace

std::vector<std::string> eglDevices()
{
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base"))
        return {};
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count) != EGL_TRUE)
        return {};
    std::vector<std::string> names;
    for (EGLint i = 0; i < count; ++i)
        names.push_back(deviceName(devices[size_t(i)]));
    return names;
}

} // namespace fx::cli
