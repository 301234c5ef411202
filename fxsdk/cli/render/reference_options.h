/// @file reference_options.h
/// The arguments of fx render that belong to the renderers without a GPU.
#pragma once

#include "foundation/result/status.h"
#include "rendering/reference/integral/integral_scheme.h"
#include "rendering/reference/render/tile_renderer.h"

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace fx::cli {

/// Arguments as they are written on the command line.
struct ReferenceArguments
{
    std::string integrator = "gauss-5";
    std::string precision = "double";
    std::string source = "per-blob";
    std::string scattering = "centers";
    /// detail of fields: "on", "off", or "auto": on if the composition of the scene draws it
    std::string detail = "auto";
    std::string view;   ///< "ex,ey,ez,tx,ty,tz,fov": replaces the camera
    std::string camera; ///< path of a scene file; its camera replaces that of the scene
    int skyRings = 3; ///< number of rings of sky directions: 4 skyRings^2 directions with --scattering single
    int samples = 1;
    std::optional<uint32_t> paths;   ///< paths per pixel; empty: 64, or as many as `error` requires
    std::optional<double> error;     ///< [1] requested standard error of written values
    std::optional<uint32_t> bounces; ///< largest number of scattering events; empty: no limit
    double sunAngle = 0.53;          ///< [degree] diameter of the sun
    uint32_t threads = 0;            ///< number of threads; 0: all hardware threads
    bool resume = false;
};

/// Checked and converted arguments.
struct ReferencePlan
{
    render::IntegralSettings integral;
    bool isSingle = false;
    render::ScatteringMode scattering = render::ScatteringMode::Centers;
    std::optional<render::ReferenceCamera> camera; ///< camera of --view
};

void addReferenceOptions(CLI::App& command, ReferenceArguments& arguments);
void addPathOptions(CLI::App& command, ReferenceArguments& arguments);

/// Converts and checks the arguments. @return InvalidArgument, which is a usage error
base::Result<ReferencePlan> planReference(const ReferenceArguments& arguments);

/// Checks that a picture, its copy for the file and the file itself fit into the memory of the machine.
/// @param memory [byte] memory of the machine; 0 if unknown
/// @return OutOfMemory with the bytes needed and the largest size that fits
base::Status checkPictureMemory(int width, int height, uint64_t memory);

/// Parses "ex,ey,ez,tx,ty,tz,fov_y_degrees": eye and target [m], which must differ, and field of view.
base::Result<render::ReferenceCamera> parseView(const std::string& text);

} // namespace fx::cli
