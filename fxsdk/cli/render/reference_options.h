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

/// As written on the command line.
struct ReferenceArguments
{
    std::string integrator = "gauss-5";
    std::string precision = "double";
    std::string source = "per-blob";
    std::string scattering = "centers";
    std::string detail = "auto"; ///< of fields: on, off, or as the composition of the scene draws it
    std::string view;            ///< "ex,ey,ez,tx,ty,tz,fov": replaces the camera
    std::string camera;          ///< a scene file whose camera is used
    int skyRings = 3;            ///< 4 skyRings^2 directions of the sky with --scattering single
    int samples = 1;
    std::optional<uint32_t> paths;   ///< of a pixel; empty: 64, or as many as `error` requires
    std::optional<double> error;     ///< [1] standard error of written values
    std::optional<uint32_t> bounces; ///< none: any number
    double sunAngle = 0.53;          ///< [degree] diameter of the sun
    uint32_t threads = 0;            ///< 0: all
    bool resume = false;
};

/// Checked and understood.
struct ReferencePlan
{
    render::IntegralSettings integral;
    bool isSingle = false;
    render::ScatteringMode scattering = render::ScatteringMode::Centers;
    std::optional<render::ReferenceCamera> camera; ///< of --view
};

void addReferenceOptions(CLI::App& command, ReferenceArguments& arguments);
void addPathOptions(CLI::App& command, ReferenceArguments& arguments);

/// @return InvalidArgument, which is a usage error
base::Result<ReferencePlan> planReference(const ReferenceArguments& arguments);

/// Whether a picture, with its copy for the file and the file itself, fits into the machine.
/// @param memory [byte] of the machine; 0 for unknown
/// @return OutOfMemory with the bytes needed and the largest size that fits
base::Status checkPictureMemory(int width, int height, uint64_t memory);

/// Understands "ex,ey,ez,tx,ty,tz,fov_y_degrees": eye and target [m], different.
base::Result<render::ReferenceCamera> parseView(const std::string& text);

} // namespace fx::cli
