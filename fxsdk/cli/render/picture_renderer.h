/// @file picture_renderer.h
/// Common interface of the CPU renderers of fx render.
#pragma once

#include "fxsdk/cli/render/reference_options.h"
#include "rendering/exr/exr_encoder.h"
#include "rendering/reference/render/reference_scene.h"
#include "rendering/reference/render/seen_outputs.h"
#include "rendering/reference/render/tiled_picture.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace fx::cli {

/// Renders one picture at a time. The functions correspond to those of ReferenceRenderer and PathRenderer.
class PictureRenderer
{
public:
    virtual ~PictureRenderer() = default;

    /// Prepares the renderer for a scene.
    /// @param exposure [m2/cd] written value per unit of luminance
    virtual base::Status build(const render::ReferenceScene& scene, double exposure,
                               base::TaskRunner& tasks) = 0;
    virtual uint64_t key() const = 0;
    virtual uint32_t tileCount() const = 0;
    virtual void restore(uint32_t tile, std::span<const float> values) = 0;
    virtual base::Status render(render::TileJournal* journal, const render::RenderCallbacks& callbacks) = 0;
    /// Adds the rendered channels to an EXR image.
    /// @param outPixels owns the pixels that the channels of `io` point to
    virtual void addChannels(render::ExrImage& io, std::vector<std::vector<float>>& outPixels) const = 0;
    /// Adds statistics of the picture to a JSON object.
    /// @param seconds [s] duration of render()
    virtual void addStatistics(nlohmann::json& io, double seconds) const = 0;
    virtual uint64_t nonFinite() const = 0; ///< number of values or paths whose result was not finite
};

/// Creates a renderer that integrates along view rays.
/// @param past data for --outputs motion; null: the channels of --outputs are not written
std::unique_ptr<PictureRenderer> makeReferencePicture(const ReferenceArguments& arguments,
                                                      const ReferencePlan& plan, int width, int height,
                                                      const render::ReferencePast* past = nullptr);
std::unique_ptr<PictureRenderer> makePathPicture(const ReferenceArguments& arguments, int width, int height,
                                                 std::optional<uint64_t> seed);

} // namespace fx::cli
